// <image topic>/theora for image_transport.
#include <memory>
#include <mutex>

#include <cv_bridge/cv_bridge.h>
#include <dynamic_reconfigure/server.h>
#include <image_transport/simple_publisher_plugin.h>
#include <image_transport/simple_subscriber_plugin.h>
#include <pluginlib/class_list_macros.hpp>
#include <sensor_msgs/image_encodings.h>
#include <theora_image_transport/TheoraPublisherConfig.h>

#include "theora_image_transport/stream.h"

namespace theora_image_transport {

namespace {
constexpr double kWarnPeriod = 5.0;  // s
constexpr int kHeaders = 4;          // places in a queue beside the pictures: without headers no stream can be read
}  // namespace

// A new subscriber or parameter starts a new stream for all: headers, key frame.
class TheoraPublisher : public image_transport::SimplePublisherPlugin<Packet> {
 public:
  std::string getTransportName() const override { return "theora"; }

 protected:
  void advertiseImpl(ros::NodeHandle& nh, const std::string& topic, uint32_t queue_size,
                     const image_transport::SubscriberStatusCallback& connect,
                     const image_transport::SubscriberStatusCallback& disconnect, const ros::VoidPtr& tracked,
                     bool latch) override {
    SimplePublisherPlugin::advertiseImpl(nh, topic, queue_size + kHeaders, connect, disconnect, tracked, latch);
    server_ = std::make_unique<Server>(this->nh());
    server_->setCallback([this](TheoraPublisherConfig& config, uint32_t) {
      const std::lock_guard<std::mutex> lock(mutex_);
      enabled_ = config.enable;
      settings_ = {config.optimize_for == TheoraPublisher_Bitrate, config.target_bitrate, config.quality,
                   config.keyframe_frequency};
      encoder_.reset();
    });
  }

  void connectCallback(const ros::SingleSubscriberPublisher&) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    encoder_.reset();
  }

  void publish(const sensor_msgs::Image& image, const PublishFn& send) const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!enabled_) return;
    try {
      if (sensor_msgs::image_encodings::bitDepth(image.encoding) != 8 || image.encoding == "8UC2")
        throw std::runtime_error("'" + image.encoding + "' cannot be sent as theora, which is for 8 bits a channel");
      const auto shared = cv_bridge::toCvShare(image, boost::shared_ptr<void>(), sensor_msgs::image_encodings::BGR8);
      const cv::Mat& bgr = shared->image;
      std::vector<Packet> packets;
      if (!encoder_ || encoder_->size() != bgr.size()) {
        encoder_ = std::make_unique<Encoder>(bgr.size(), settings_);
        packets = encoder_->headers();
      }
      const auto pictures = encoder_->encode(bgr);
      packets.insert(packets.end(), pictures.begin(), pictures.end());
      for (auto& packet : packets) {
        packet.header = image.header;
        send(packet);
      }
    } catch (const std::runtime_error& error) {  // cv_bridge's too
      ROS_ERROR_THROTTLE(kWarnPeriod, "%s stays empty: %s", getTopic().c_str(), error.what());
    } catch (const cv::Exception& error) {
      ROS_ERROR_THROTTLE(kWarnPeriod, "%s stays empty: %s", getTopic().c_str(), error.err.c_str());
    }
  }

 private:
  using Server = dynamic_reconfigure::Server<TheoraPublisherConfig>;
  mutable std::mutex mutex_;
  bool enabled_ = true;
  Settings settings_;
  mutable std::unique_ptr<Encoder> encoder_;
  std::unique_ptr<Server> server_;
};

class TheoraSubscriber : public image_transport::SimpleSubscriberPlugin<Packet> {
 public:
  std::string getTransportName() const override { return "theora"; }

 protected:
  void subscribeImpl(ros::NodeHandle& nh, const std::string& topic, uint32_t queue_size, const Callback& callback,
                     const ros::VoidPtr& tracked, const image_transport::TransportHints& hints) override {
    SimpleSubscriberPlugin::subscribeImpl(nh, topic, queue_size + kHeaders, callback, tracked, hints);
    decoder_.postProcess(this->nh().param("post_processing_level", 0));
  }

  void internalCallback(const PacketConstPtr& packet, const Callback& callback) override {
    cv::Mat picture;
    try {
      picture = decoder_.decode(*packet);
    } catch (const std::runtime_error& error) {
      ROS_ERROR_THROTTLE(kWarnPeriod, "%s: %s", getTopic().c_str(), error.what());
      return;
    }
    if (!picture.empty())
      callback(cv_bridge::CvImage(packet->header, sensor_msgs::image_encodings::BGR8, picture).toImageMsg());
  }

 private:
  Decoder decoder_;
};

}  // namespace theora_image_transport

PLUGINLIB_EXPORT_CLASS(theora_image_transport::TheoraPublisher, image_transport::PublisherPlugin)
PLUGINLIB_EXPORT_CLASS(theora_image_transport::TheoraSubscriber, image_transport::SubscriberPlugin)
