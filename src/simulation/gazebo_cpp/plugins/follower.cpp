// libFollowerPlugin.so: a robot on two wheels that goes to what is nearest in the middle row of its depth camera.
#include <cmath>
#include <mutex>
#include <stdexcept>
#include <vector>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>

namespace gazebo
{

class FollowerPlugin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    for (const physics::LinkPtr& link : model->GetLinks())
      for (unsigned int i = 0; i < link->GetSensorCount() && !sensor_; ++i)
        sensor_ = std::dynamic_pointer_cast<sensors::DepthCameraSensor>(sensors::get_sensor(link->GetSensorName(i)));
    if (!sensor_)
      throw std::runtime_error("the model has no sensor of type depth to look with");
    for (const char* tag : { "left_joint", "right_joint" })
      if (sdf->HasElement(tag))
        wheels_.push_back(model->GetJoint(sdf->Get<std::string>(tag)));
    if (wheels_.size() < 2 || !wheels_[0] || !wheels_[1])
      wheels_ = firstHinges(*model);
    frames_ = sensor_->DepthCamera()->ConnectNewDepthFrame(
        [this](const float* depths, unsigned int width, unsigned int height, unsigned int, const std::string&) {
          const std::lock_guard<std::mutex> lock(mutex_);
          const float* row = depths + static_cast<std::size_t>(height / 2) * width;
          row_.assign(row, row + width);
        });
    sensor_->SetActive(true);
    update_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo&) { OnUpdate(); });
  }
  // The widest side of a wheel is taken for its diameter.
  void Init() override
  {
    apart_ = wheels_[0]->Anchor(0).Distance(wheels_[1]->Anchor(0));
    radius_ = wheels_[0]->GetChild()->BoundingBox().Size().Max() / 2;
    if (!(radius_ > 0) || !std::isfinite(radius_))
      throw std::runtime_error("link '" + wheels_[0]->GetChild()->GetName() +
                               "', a wheel, has no collision that says how large it is");
  }
  void Reset() override
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    row_.clear();
  }

private:
  static constexpr float NEAREST = 0.1f, FARTHEST = 5, CLOSE = 0.4f;  // m; closer than the last it stops
  static constexpr double SPEED = -0.1, TURN = 0.1;  // m/s, rad/s at the edge of the picture; all these are Gazebo's

  static std::vector<physics::JointPtr> firstHinges(const physics::Model& model)
  {
    std::vector<physics::JointPtr> found;
    for (const physics::JointPtr& joint : model.GetJoints())
      if (found.size() < 2 && joint->HasType(physics::Base::HINGE_JOINT))
        found.push_back(joint);
    if (found.size() < 2)
      throw std::runtime_error("<left_joint> and <right_joint> do not name two joints, and the model has no two revolute ones");
    return found;
  }

  void drive(double left, double right)
  {
    wheels_[0]->SetVelocity(0, left / radius_);
    wheels_[1]->SetVelocity(0, right / radius_);
  }

  void OnUpdate()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (row_.empty())
      return;
    float least = FARTHEST;
    std::size_t where = row_.size();
    for (std::size_t i = 0; i < row_.size(); ++i)
      if (row_[i] > NEAREST && row_[i] < least)
        least = row_[i], where = i;
    if (where == row_.size() || least < CLOSE)
      return drive(0, 0);
    const double turn = (1 - where / (row_.size() / 2.0)) * TURN;
    drive(SPEED + turn * apart_ / 2, SPEED - turn * apart_ / 2);
  }

  sensors::DepthCameraSensorPtr sensor_;
  std::vector<physics::JointPtr> wheels_;  // left, right
  double apart_ = 1, radius_ = 1;          // m
  std::mutex mutex_;
  std::vector<float> row_;  // m
  event::ConnectionPtr frames_, update_;
};
GZ_REGISTER_MODEL_PLUGIN(FollowerPlugin)

}  // namespace gazebo
