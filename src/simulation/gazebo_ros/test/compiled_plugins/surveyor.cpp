// A model plugin that tells what its model is made of: shapes, height maps, joints, batteries, the air. <resize> gives a ball or a
// cylinder another size, <time> the world another time, <hear> is a topic of Gazebo's whose numbers it repeats; with <throws> the law of its battery does.
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/transport/transport.hh>
#include <ros/ros.h>
#include <std_msgs/String.h>

namespace gazebo
{

class Surveyor : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    model_ = model;
    told_ = ros::NodeHandle().advertise<std_msgs::String>("surveyed", 100, true);
    if (sdf->HasElement("resize"))
      resize(sdf->Get<ignition::math::Vector2d>("resize"));
    if (sdf->HasElement("hear"))
    {
      node_.reset(new transport::Node);
      node_->Init();
      heard_ = node_->Subscribe(sdf->Get<std::string>("hear"), &Surveyor::OnNumber, this);
      return;
    }
    std::ostringstream text;
    for (const physics::LinkPtr& link : model->GetLinks())
    {
      for (const physics::CollisionPtr& collision : link->GetCollisions())
        shape(text, *collision->GetShape());
      for (std::size_t i = 0; i < link->BatteryCount(); ++i)
        battery(text, *link->Battery(i));
    }
    for (const physics::JointPtr& joint : model->GetJoints())
      text << "joint " << joint->GetStopStiffness(0) << " " << joint->GetStopDissipation(0) << " " << joint->GetInertiaRatio(0)
           << " " << joint->AxisFrame(0) << " " << joint->AxisFrameOffset(0) << " " << joint->GetWorldEnergyPotentialSpring(0)
           << "\n";
    const physics::WorldPtr world = model->GetWorld();
    const physics::Atmosphere& air = world->Atmosphere();
    text << "air " << air.Type() << " " << air.Temperature(1000) << " " << air.Pressure(1000) << " " << air.MassDensity() << " "
         << air.MassDensity(1000) << "\n";
    if (sdf->HasElement("throws"))
      model->GetLink("b")->Battery("bat")->SetUpdateFunc(
          [](const common::BatteryPtr&) -> double { throw std::runtime_error("told to fail"); });
    if (sdf->HasElement("time"))
    {
      world->SetSimTime(common::Time(sdf->Get<double>("time")));
      text << "time " << world->SimTime().Double() << "\n";
    }
    tell(text.str());
  }

  void Reset() override { tell("reset"); }

private:
  void tell(const std::string& what)
  {
    std_msgs::String message;
    message.data = model_->GetName() + "\n" + what;
    told_.publish(message);
  }
  void OnNumber(ConstIntPtr& message) { tell("heard " + std::to_string(message->data())); }

  void resize(const ignition::math::Vector2d& size)
  {
    const physics::ShapePtr shape = model_->GetLinks()[0]->GetCollisions()[0]->GetShape();
    if (const auto ball = boost::dynamic_pointer_cast<physics::SphereShape>(shape))
      ball->SetRadius(size.X());
    if (const auto cylinder = boost::dynamic_pointer_cast<physics::CylinderShape>(shape))
      cylinder->SetSize(size.X(), size.Y());
  }
  static void shape(std::ostream& text, physics::Shape& shape)
  {
    msgs::Geometry message;
    shape.FillMsg(message);
    text << "shape " << shape.ComputeVolume() << " " << message.ShortDebugString() << "\n";
    if (const auto* map = dynamic_cast<const physics::HeightmapShape*>(&shape))
      heights(text, *map);
  }
  static void heights(std::ostream& text, const physics::HeightmapShape& map)
  {
    const int most = map.VertexCount().X() - 1;
    text << "map " << map.VertexCount() << " " << map.GetMinHeight() << " " << map.GetMaxHeight() << "\n";
    for (int row = 0; row <= most; row += most / 4)
    {
      text << "row";
      for (int column = 0; column <= most; column += most / 4)
        text << " " << map.GetHeight(column, row);
      text << "\n";
    }
    text << "beyond " << map.GetHeight(-1, 0) << " " << map.GetHeight(0, 10000) << "\n";
  }
  static void battery(std::ostream& text, common::Battery& battery)
  {
    const uint32_t consumer = battery.AddConsumer();
    double load = 0, none = 0;
    const bool set = battery.SetPowerLoad(consumer, 5), known = battery.PowerLoad(consumer, load);
    text << "battery " << battery.Name() << " " << battery.Voltage() << " " << consumer << " " << set << known << " " << load
         << " " << battery.PowerLoad(99, none) << " " << battery.PowerLoads().size() << "\n";
  }

  physics::ModelPtr model_;
  ros::Publisher told_;
  transport::NodePtr node_;
  transport::SubscriberPtr heard_;
};

GZ_REGISTER_MODEL_PLUGIN(Surveyor)

}  // namespace gazebo
