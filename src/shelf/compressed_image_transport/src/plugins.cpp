// <image topic>/compressed for image_transport.
#include <memory>
#include <mutex>

#include <compressed_image_transport/CompressedPublisherConfig.h>
#include <dynamic_reconfigure/server.h>
#include <image_transport/simple_publisher_plugin.h>
#include <image_transport/simple_subscriber_plugin.h>
#include <opencv2/imgcodecs.hpp>
#include <pluginlib/class_list_macros.hpp>

#include "compressed_image_transport/codec.h"

namespace compressed_image_transport {

namespace {
constexpr double kWarnPeriod = 5.0;  // s
}

class CompressedPublisher : public image_transport::SimplePublisherPlugin<sensor_msgs::CompressedImage> {
 public:
  std::string getTransportName() const override { return "compressed"; }

 protected:
  void advertiseImpl(ros::NodeHandle& nh, const std::string& topic, uint32_t queue_size,
                     const image_transport::SubscriberStatusCallback& connect,
                     const image_transport::SubscriberStatusCallback& disconnect, const ros::VoidPtr& tracked,
                     bool latch) override {
    SimplePublisherPlugin::advertiseImpl(nh, topic, queue_size, connect, disconnect, tracked, latch);
    server_ = std::make_unique<Server>(this->nh());
    server_->setCallback([this](CompressedPublisherConfig& config, uint32_t) {
      const std::lock_guard<std::mutex> lock(mutex_);
      config_ = config;
    });
  }

  void publish(const sensor_msgs::Image& image, const PublishFn& send) const override {
    CompressedPublisherConfig config;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      config = config_;
    }
    if (!config.enable) return;
    try {
      if (config.format == CompressedPublisher_png)
        send(encode(image, Format::png, {cv::IMWRITE_PNG_COMPRESSION, config.png_level}));
      else
        send(encode(image, Format::jpeg,
                    {cv::IMWRITE_JPEG_QUALITY, config.jpeg_quality,          //
                     cv::IMWRITE_JPEG_PROGRESSIVE, config.jpeg_progressive,  //
                     cv::IMWRITE_JPEG_OPTIMIZE, config.jpeg_optimize,        //
                     cv::IMWRITE_JPEG_RST_INTERVAL, config.jpeg_restart_interval}));
    } catch (const std::runtime_error& error) {
      ROS_ERROR_THROTTLE(kWarnPeriod, "%s stays empty: %s", getTopic().c_str(), error.what());
    }
  }

 private:
  using Server = dynamic_reconfigure::Server<CompressedPublisherConfig>;
  mutable std::mutex mutex_;
  CompressedPublisherConfig config_ = CompressedPublisherConfig::__getDefault__();
  std::unique_ptr<Server> server_;
};

class CompressedSubscriber : public image_transport::SimpleSubscriberPlugin<sensor_msgs::CompressedImage> {
 public:
  std::string getTransportName() const override { return "compressed"; }

 protected:
  void subscribeImpl(ros::NodeHandle& nh, const std::string& topic, uint32_t queue_size, const Callback& callback,
                     const ros::VoidPtr& tracked, const image_transport::TransportHints& hints) override {
    SimpleSubscriberPlugin::subscribeImpl(nh, topic, queue_size, callback, tracked, hints);
    const std::string mode = this->nh().param<std::string>("mode", "unchanged");
    mode_ = mode == "gray" ? Mode::gray : mode == "color" ? Mode::color : Mode::unchanged;
    if (mode_ == Mode::unchanged && mode != "unchanged")
      ROS_ERROR("Parameter %s is '%s', but must be unchanged, gray or color; it is taken as unchanged.",
                this->nh().resolveName("mode").c_str(), mode.c_str());
  }

  void internalCallback(const sensor_msgs::CompressedImageConstPtr& message, const Callback& callback) override {
    sensor_msgs::ImagePtr image;
    try {
      image = decode(*message, mode_);
    } catch (const std::runtime_error& error) {
      ROS_ERROR_THROTTLE(kWarnPeriod, "%s: %s", getTopic().c_str(), error.what());
      return;
    }
    callback(image);
  }

 private:
  Mode mode_ = Mode::unchanged;
};

}  // namespace compressed_image_transport

PLUGINLIB_EXPORT_CLASS(compressed_image_transport::CompressedPublisher, image_transport::PublisherPlugin)
PLUGINLIB_EXPORT_CLASS(compressed_image_transport::CompressedSubscriber, image_transport::SubscriberPlugin)
