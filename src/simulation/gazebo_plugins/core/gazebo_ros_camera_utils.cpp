#include <gazebo_plugins/gazebo_ros_camera_utils.h>

#include <cmath>
#include <map>

#include <boost/algorithm/string.hpp>
#include <gazebo/rendering/Camera.hh>
#include <sensor_msgs/image_encodings.h>

namespace gazebo
{

GazeboRosCameraUtils::GazeboRosCameraUtils() = default;

GazeboRosCameraUtils::~GazeboRosCameraUtils()
{
  if (parentSensor_)
    parentSensor_->SetActive(false);
  delete dyn_srv_;
  image_pub_.shutdown(), camera_info_pub_.shutdown();
  if (rosnode_)
    rosnode_->shutdown();
  camera_queue_.clear(), camera_queue_.disable();
  const boost::weak_ptr<int> callbacks(alive_);
  alive_.reset();
  for (int i = 0; i < 1000 && !callbacks.expired(); ++i)  // one of them runs
    ros::WallDuration(0.001).sleep();
  if (callback_queue_thread_.joinable())
    callback_queue_thread_.join();
  camera_info_manager_.reset();
  delete itnode_;
  delete rosnode_;
}

event::ConnectionPtr GazeboRosCameraUtils::OnLoad(const boost::function<void()>& f) { return load_event_.Connect(f); }

void GazeboRosCameraUtils::Load(sensors::SensorPtr parent, sdf::ElementPtr element, const std::string& suffix,
                                double hack_baseline)
{
  given_baseline_.reset(new double(hack_baseline));
  Load(parent, element, suffix);
}

void GazeboRosCameraUtils::Load(sensors::SensorPtr parent, sdf::ElementPtr element, const std::string& suffix)
{
  world = world_ = physics::get_world(parent->WorldName());
  sdf = element;
  if (!parentSensor_)
    parentSensor_ = parent;
  if (!camera_)
    gzthrow("GazeboRosCameraUtils::Load(): the plugin has not set camera_ before");
  if (!ros::isInitialized())
    gzthrow("GazeboRosCameraUtils::Load(): ROS is not initialized");
  readTags(suffix);
  parentSensor_->SetActive(false);  // until somebody listens
  if (!image_connect_count_)
    image_connect_count_.reset(new int(0));
  if (!image_connect_count_lock_)
    image_connect_count_lock_.reset(new boost::mutex);
  if (!was_active_)
    was_active_.reset(new bool(false));
  encoding();
  advertise();
  load_event_();
  initialized_ = true;
}

void GazeboRosCameraUtils::readTags(const std::string& suffix)
{
  const auto text = [&](const char* tag, std::string& value, const std::string& otherwise) {
    value =
        sdf->HasElement(tag) ? sdf->Get<std::string>(tag) : otherwise;  // whatever a derived class has set before, as upstream
  };
  const auto number = [&](const char* tag, double& value) { value = sdf->HasElement(tag) ? sdf->Get<double>(tag) : 0; };
  robot_namespace_ = GetRobotNamespace(parentSensor_, sdf, "Camera");
  text("imageTopicName", image_topic_name_, "image_raw");
  text("cameraInfoTopicName", camera_info_topic_name_, "camera_info");
  text("cameraName", camera_name_, "");
  text("frameName", frame_name_, "");
  camera_name_ += suffix;
  number("updateRate", update_rate_);
  update_period_ = update_rate_ > 0 ? 1 / update_rate_ : 0;
  number("CxPrime", cx_prime_), number("Cx", cx_), number("Cy", cy_);
  number("focalLength", focal_length_), number("hackBaseline", hack_baseline_);
  if (given_baseline_)
    hack_baseline_ = *given_baseline_;
  number("distortionK1", distortion_k1_), number("distortionK2", distortion_k2_), number("distortionK3", distortion_k3_);
  number("distortionT1", distortion_t1_), number("distortionT2", distortion_t2_);
  auto_distortion_ = sdf->HasElement("autoDistortion") && sdf->Get<bool>("autoDistortion");
  border_crop_ = !sdf->HasElement("borderCrop") || sdf->Get<bool>("borderCrop");
  const rendering::DistortionPtr lens = camera_->LensDistortion();
  if (!lens)
    return;
  lens->SetCrop(border_crop_);
  if (auto_distortion_)
  {
    distortion_k1_ = lens->K1(), distortion_k2_ = lens->K2(), distortion_k3_ = lens->K3();
    distortion_t1_ = lens->P1(), distortion_t2_ = lens->P2();
  }
}

void GazeboRosCameraUtils::encoding()
{
  namespace names = sensor_msgs::image_encodings;
  static const std::map<std::string, std::string> encodings = { { "L8", names::MONO8 },
                                                                { "L_INT8", names::MONO8 },
                                                                { "L16", names::MONO16 },
                                                                { "L_INT16", names::MONO16 },
                                                                { "R8G8B8", names::RGB8 },
                                                                { "RGB_INT8", names::RGB8 },
                                                                { "B8G8R8", names::BGR8 },
                                                                { "BGR_INT8", names::BGR8 },
                                                                { "R16G16B16", names::RGB16 },
                                                                { "RGB_INT16", names::RGB16 },
                                                                { "BAYER_RGGB8", names::BAYER_RGGB8 },
                                                                { "BAYER_BGGR8", names::BAYER_BGGR8 },
                                                                { "BAYER_GBRG8", names::BAYER_GBRG8 },
                                                                { "BAYER_GRBG8", names::BAYER_GRBG8 } };
  const auto found = encodings.find(format_);
  if (found == encodings.end())
    ROS_ERROR_NAMED("camera_utils", "sensor %s: unknown image format '%s', bgr8 is published", parentSensor_->Name().c_str(),
                    format_.c_str());
  type_ = found == encodings.end() ? names::BGR8 : found->second;
  skip_ = static_cast<int>(camera_->ImageDepth());
}

void GazeboRosCameraUtils::advertise()
{
  rosnode_ = new ros::NodeHandle(robot_namespace_ + "/" + camera_name_);
  std::string key;
  if (rosnode_->searchParam("tf_prefix", key))
    rosnode_->getParam(key, tf_prefix_);
  else
    tf_prefix_ = boost::trim_right_copy_if(robot_namespace_, boost::is_any_of("/"));
  if (!frame_name_.empty() && frame_name_[0] == '/')
    frame_name_ = frame_name_.substr(1);
  else if (!frame_name_.empty() && !tf_prefix_.empty())
    frame_name_ = boost::trim_copy_if(tf_prefix_, boost::is_any_of("/")) + "/" + frame_name_;
  ROS_INFO_NAMED("camera_utils", "Camera Plugin (ns = %s)  <tf_prefix_>, set to \"%s\"", robot_namespace_.c_str(),
                 tf_prefix_.c_str());
  camera_info_manager_.reset(new camera_info_manager::CameraInfoManager(*rosnode_, camera_name_));
  camera_info_manager_->setCameraInfo(info());
  itnode_ = new image_transport::ImageTransport(*rosnode_);
  if (camera_name_.empty())
    ROS_WARN_NAMED("camera_utils",
                   "dynamic reconfigure is not enabled for this image topic [%s] becuase <cameraName> is not specified",
                   image_topic_name_.c_str());  // upstream's spelling
  else
  {
    dyn_srv_ = new dynamic_reconfigure::Server<gazebo_plugins::GazeboRosCameraConfig>(*rosnode_);
    dyn_srv_->setCallback(
        [this](gazebo_plugins::GazeboRosCameraConfig& config, uint32_t level) { configCallback(config, level); });
  }
  alive_.reset(new int(0));
  image_pub_ = itnode_->advertise(
      image_topic_name_, 2, [this](const image_transport::SingleSubscriberPublisher&) { ImageConnect(); },
      [this](const image_transport::SingleSubscriberPublisher&) { ImageDisconnect(); }, alive_, true);
  auto options = ros::AdvertiseOptions::create<sensor_msgs::CameraInfo>(
      camera_info_topic_name_, 2, [this](const ros::SingleSubscriberPublisher&) { ImageConnect(); },
      [this](const ros::SingleSubscriberPublisher&) { ImageDisconnect(); }, alive_, &camera_queue_);
  camera_info_pub_ = rosnode_->advertise(options);
  callback_queue_thread_ = boost::thread([this] { CameraQueueThread(); });
}

sensor_msgs::CameraInfo GazeboRosCameraUtils::info()
{
  const double computed = width_ / (2 * std::tan(camera_->HFOV().Radian() / 2));
  if (cx_prime_ == 0)
    cx_prime_ = (width_ + 1) / 2.0;
  if (cx_ == 0)
    cx_ = (width_ + 1) / 2.0;
  if (cy_ == 0)
    cy_ = (height_ + 1) / 2.0;
  if (focal_length_ != 0 && std::abs(focal_length_ - computed) > 1e-8)
    ROS_WARN_NAMED("camera_utils", "sensor %s: <focalLength> %g does not fit width %u and horizontal_fov, which give %g",
                   parentSensor_->Name().c_str(), focal_length_, width_, computed);
  const double f = focal_length_ = focal_length_ == 0 ? computed : focal_length_;
  sensor_msgs::CameraInfo info;
  info.header.frame_id = frame_name_;
  info.width = width_, info.height = height_;
  info.distortion_model = "plumb_bob";
  info.D = { distortion_k1_, distortion_k2_, distortion_t1_, distortion_t2_, distortion_k3_ };
  info.K = { f, 0, cx_, 0, f, cy_, 0, 0, 1 };
  info.R = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  info.P = { f, 0, cx_, -f * hack_baseline_, 0, f, cy_, 0, 0, 0, 1, 0 };
  return info;
}

void GazeboRosCameraUtils::configCallback(gazebo_plugins::GazeboRosCameraConfig& config, uint32_t)
{
  if (initialized_)  // the default is not the user's wish
    parentSensor_->SetUpdateRate(config.imager_rate);
}

// -- who listens --------------------------------------------------------------------------------------------------------------------

void GazeboRosCameraUtils::ImageConnect()
{
  const boost::mutex::scoped_lock lock(*image_connect_count_lock_);
  if (*image_connect_count_ == 0)
    *was_active_ = parentSensor_->IsActive();
  ++*image_connect_count_;
  parentSensor_->SetActive(true);
}

void GazeboRosCameraUtils::ImageDisconnect()
{
  const boost::mutex::scoped_lock lock(*image_connect_count_lock_);
  --*image_connect_count_;
  if (*image_connect_count_ <= 0 && !*was_active_)
    parentSensor_->SetActive(false);
}

void GazeboRosCameraUtils::CameraQueueThread()
{
  while (rosnode_->ok())
    camera_queue_.callAvailable(ros::WallDuration(0.05));
}

// -- messages -----------------------------------------------------------------------------------------------------------------------

void GazeboRosCameraUtils::PutCameraData(const unsigned char* image, common::Time& time)
{
  sensor_update_time_ = time;
  PutCameraData(image);
}

void GazeboRosCameraUtils::PutCameraData(const unsigned char* image)
{
  if (!initialized_ || !width_ || !height_ || *image_connect_count_ <= 0)
    return;
  const boost::mutex::scoped_lock lock(lock_);
  image_msg_.header.frame_id = frame_name_;
  image_msg_.header.stamp =
      ros::Time(static_cast<uint32_t>(sensor_update_time_.sec), static_cast<uint32_t>(sensor_update_time_.nsec));
  sensor_msgs::fillImage(image_msg_, type_, height_, width_, static_cast<uint32_t>(skip_) * width_, image);
  image_pub_.publish(image_msg_);
}

void GazeboRosCameraUtils::PublishCameraInfo(common::Time& time)
{
  sensor_update_time_ = time;
  PublishCameraInfo();
}

void GazeboRosCameraUtils::PublishCameraInfo()
{
  if (!initialized_ || !width_ || !height_ || camera_info_pub_.getNumSubscribers() == 0)
    return;
  sensor_update_time_ = parentSensor_->LastMeasurementTime();
  if (sensor_update_time_ < last_info_update_time_)  // time was reset
    last_info_update_time_ = common::Time();
  if (sensor_update_time_ - last_info_update_time_ < common::Time(update_period_))
    return;
  PublishCameraInfo(camera_info_pub_);
  last_info_update_time_ = sensor_update_time_;
}

void GazeboRosCameraUtils::PublishCameraInfo(ros::Publisher publisher)
{
  sensor_msgs::CameraInfo info = camera_info_manager_->getCameraInfo();
  info.header.frame_id = frame_name_;
  info.header.stamp =
      ros::Time(static_cast<uint32_t>(sensor_update_time_.sec), static_cast<uint32_t>(sensor_update_time_.nsec));
  publisher.publish(info);
}

}  // namespace gazebo
