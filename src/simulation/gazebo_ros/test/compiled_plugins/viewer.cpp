// A plugin of a model that reads its cameras: publishes what it sees of something red in each picture, and does what it is told.
#include <sstream>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/rendering/rendering.hh>
#include <gazebo/sensors/sensors.hh>
#include <ros/ros.h>
#include <std_msgs/Float64MultiArray.h>
#include <std_msgs/String.h>

namespace gazebo
{

class Viewer : public ModelPlugin
{
public:
  void Load(physics::ModelPtr, sdf::ElementPtr sdf) override
  {
    const std::string name = sdf->Get<std::string>("sensor");
    sensor_ = sensors::SensorManager::Instance()->GetSensor(name);
    throws_ = sdf->HasElement("throws") ? sdf->Get<int>("throws") : -1;
    frames_ = nh_.advertise<std_msgs::Float64MultiArray>("view/" + name, 1000, true);
    orders_ = nh_.subscribe("view/" + name + "/order", 10, &Viewer::OnOrder, this);
    done_ = nh_.advertise<std_msgs::String>("view/" + name + "/done", 10);
    if (const auto several = std::dynamic_pointer_cast<sensors::MultiCameraSensor>(sensor_))
      for (unsigned int i = 0; i < several->CameraCount(); ++i)
        Watch(several->Camera(i), i);
    else
      Watch(std::dynamic_pointer_cast<sensors::CameraSensor>(sensor_)->Camera(), 0);
  }

private:
  void Watch(rendering::CameraPtr camera, int number)
  {
    cameras_.push_back(camera);
    connections_.push_back(camera->ConnectNewImageFrame(
        [this, camera, number](const unsigned char* image, unsigned int width, unsigned int height, unsigned int depth,
                               const std::string& format) { OnFrame(*camera, number, image, width, height, depth, format); }));
  }

  void OnFrame(rendering::Camera& camera, int number, const unsigned char* image, unsigned int width, unsigned int height,
               unsigned int depth, const std::string& format)
  {
    if (throws_ >= 0 && throws_-- == 0)
      throw std::runtime_error("no film");
    uint32_t hash = 2166136261u;
    unsigned int count = 0, left = width, right = 0, top = height, bottom = 0;
    for (unsigned int row = 0; row < height; ++row)
      for (unsigned int column = 0; column < width; ++column)
      {
        const unsigned char* const pixel = image + (row * width + column) * depth;
        for (unsigned int k = 0; k < depth; ++k)
          hash = (hash ^ pixel[k]) * 16777619u;
        if (depth != 3 || pixel[0] < 2 * pixel[1] || pixel[0] < 2 * pixel[2] || pixel[0] < 40)
          continue;
        ++count;
        left = std::min(left, column), right = std::max(right, column), top = std::min(top, row),
        bottom = std::max(bottom, row);
      }
    std_msgs::Float64MultiArray message;
    const auto add = [&](double value) { message.data.push_back(value); };
    add(sensor_->LastMeasurementTime().Double()), add(number), add(width), add(height), add(depth), add(hash);
    add(count), add(left), add(right), add(top), add(bottom), add(camera.WorldPose().Pos().Y());
    const bool same = camera.ImageData() == image && camera.ImageFormat() == format;
    add(same && camera.GetScene()->SimTime() == sensor_->LastMeasurementTime()), add(camera.HFOV().Radian());
    frames_.publish(message);
  }

  void OnOrder(const std_msgs::StringConstPtr& message)
  {
    std::istringstream words(message->data);
    std::string order, text;
    double number = 0;
    words >> order >> text;
    std::istringstream(text) >> number;
    rendering::Camera& camera = *cameras_.front();
    if (order == "active")
      sensor_->SetActive(number > 0);
    else if (order == "aside")
      camera.SetWorldPosition(camera.WorldPosition() + ignition::math::Vector3d(0, number, 0));
    else if (order == "hfov")
      camera.SetHFOV(ignition::math::Angle(number));
    else if (order == "width")
      camera.SetImageWidth(static_cast<unsigned int>(number));
    else if (order == "save")
      order += camera.SaveFrame(text) ? " true" : " false";
    else if (order == "visual")
    {
      const rendering::VisualPtr visual = camera.GetScene()->GetVisual(text);
      order += visual ? " " + std::to_string(visual->WorldPose().Pos().X()) : " none";
    }
    std_msgs::String answer;
    answer.data = order;
    done_.publish(answer);
  }

  ros::NodeHandle nh_;
  ros::Publisher frames_, done_;
  ros::Subscriber orders_;
  sensors::SensorPtr sensor_;
  std::vector<rendering::CameraPtr> cameras_;
  std::vector<event::ConnectionPtr> connections_;
  int throws_ = -1;
};

GZ_REGISTER_MODEL_PLUGIN(Viewer)

}  // namespace gazebo
