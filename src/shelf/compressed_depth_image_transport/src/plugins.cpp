// <image topic>/compressedDepth for image_transport.
#include <memory>
#include <mutex>

#include <compressed_depth_image_transport/CompressedDepthPublisherConfig.h>
#include <dynamic_reconfigure/server.h>
#include <image_transport/simple_publisher_plugin.h>
#include <image_transport/simple_subscriber_plugin.h>
#include <pluginlib/class_list_macros.hpp>

#include "compressed_depth_image_transport/codec.h"

namespace compressed_depth_image_transport {

namespace {
constexpr double kWarnPeriod = 5.0;  // s
}

class CompressedDepthPublisher : public image_transport::SimplePublisherPlugin<sensor_msgs::CompressedImage> {
 public:
  std::string getTransportName() const override { return "compressedDepth"; }

 protected:
  void advertiseImpl(ros::NodeHandle& nh, const std::string& topic, uint32_t queue_size,
                     const image_transport::SubscriberStatusCallback& connect,
                     const image_transport::SubscriberStatusCallback& disconnect, const ros::VoidPtr& tracked,
                     bool latch) override {
    SimplePublisherPlugin::advertiseImpl(nh, topic, queue_size, connect, disconnect, tracked, latch);
    server_ = std::make_unique<Server>(this->nh());
    server_->setCallback([this](CompressedDepthPublisherConfig& config, uint32_t) {
      const std::lock_guard<std::mutex> lock(mutex_);
      enabled_ = config.enable;
      settings_ = {config.format, config.depth_max, config.depth_quantization, config.png_level};
    });
  }

  void publish(const sensor_msgs::Image& image, const PublishFn& send) const override {
    Settings settings;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!enabled_) return;
      settings = settings_;
    }
    try {
      send(encode(image, settings));
    } catch (const std::runtime_error& error) {
      ROS_ERROR_THROTTLE(kWarnPeriod, "%s stays empty: %s", getTopic().c_str(), error.what());
    }
  }

 private:
  using Server = dynamic_reconfigure::Server<CompressedDepthPublisherConfig>;
  mutable std::mutex mutex_;
  bool enabled_ = true;
  Settings settings_;
  std::unique_ptr<Server> server_;
};

class CompressedDepthSubscriber : public image_transport::SimpleSubscriberPlugin<sensor_msgs::CompressedImage> {
 public:
  std::string getTransportName() const override { return "compressedDepth"; }

 protected:
  void internalCallback(const sensor_msgs::CompressedImageConstPtr& message, const Callback& callback) override {
    sensor_msgs::ImagePtr image;
    try {
      image = decode(*message);
    } catch (const std::runtime_error& error) {
      ROS_ERROR_THROTTLE(kWarnPeriod, "%s: %s", getTopic().c_str(), error.what());
      return;
    }
    callback(image);
  }
};

}  // namespace compressed_depth_image_transport

PLUGINLIB_EXPORT_CLASS(compressed_depth_image_transport::CompressedDepthPublisher, image_transport::PublisherPlugin)
PLUGINLIB_EXPORT_CLASS(compressed_depth_image_transport::CompressedDepthSubscriber, image_transport::SubscriberPlugin)
