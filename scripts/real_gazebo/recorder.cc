// Records what moves in a world of Gazebo Classic 11, as CSV lines in the file that TRUTH_OUT names. scripts/truth writes the
// <plugin> element of the scene into the world; its children say what is done and for how long:
//
//   <seconds>5</seconds> <every>0.01</every>     how long, and how often a row is written (simulated s)
//   <contacts>1</contacts> <wrenches>1</wrenches> <links>1</links> <sensors>1</sensors>   rows wanted besides those of models and joints
//   <do kind='...' on='model::joint' from='0' until='1' value='...'/>     see Apply() and Once()
//
// The server starts paused (gzserver -u). A thread of the plugin steps it, so that each deed lies between the same two steps in each run.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gazebo/common/common.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>
#include <gazebo/sensors/sensors.hh>

using namespace gazebo;
using ignition::math::Pose3d;
using ignition::math::Vector3d;

namespace
{

struct Deed
{
  std::string kind, on;
  double from = 0, until = 1e9;
  std::vector<double> values;
  std::string text;
  bool done = false;
};

std::string Attribute(sdf::ElementPtr element, const std::string& name, const std::string& otherwise)
{
  return element->HasAttribute(name) ? element->Get<std::string>(name) : otherwise;
}

std::vector<double> Numbers(const std::string& text)
{
  std::istringstream words(text);
  std::vector<double> numbers;
  for (double number; words >> number;)
    numbers.push_back(number);
  return numbers;
}

}  // namespace

class Recorder : public WorldPlugin
{
public:
  ~Recorder() override
  {
    if (thread_.joinable())
      thread_.detach();  // it ends the process itself
  }

  void Load(physics::WorldPtr world, sdf::ElementPtr sdf) override
  {
    world_ = world;
    const char* out = std::getenv("TRUTH_OUT");
    file_ = std::fopen(out ? out : "/tmp/truth.csv", "w");
    seconds_ = sdf->Get<double>("seconds", 1.0).first;
    every_ = sdf->Get<double>("every", 0.01).first;
    contacts_ = sdf->Get<bool>("contacts", false).first;
    wrenches_ = sdf->Get<bool>("wrenches", false).first;
    links_ = sdf->Get<bool>("links", false).first;
    sensors_ = sdf->Get<bool>("sensors", false).first;
    if (sdf->HasElement("do"))
      for (auto e = sdf->GetElement("do"); e; e = e->GetNextElement("do"))
      {
        Deed deed;
        deed.kind = Attribute(e, "kind", "");
        deed.on = Attribute(e, "on", "");
        deed.from = std::atof(Attribute(e, "from", "0").c_str());
        deed.until = std::atof(Attribute(e, "until", "1e9").c_str());
        deed.text = Attribute(e, "value", "");
        deed.values = Numbers(deed.text);
        deeds_.push_back(deed);
      }
    if (contacts_)
      world_->Physics()->GetContactManager()->SetNeverDropContacts(true);
    begin_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo&) { Apply(); });
    thread_ = std::thread([this] { Run(); });
  }

private:
  void Run()
  {
    WaitFor([this] { return Ready(); });
    const double dt = world_->Physics()->GetMaxStepSize();
    const unsigned chunk = std::max(1L, std::lround(every_ / dt));
    const long steps = std::lround(seconds_ / dt);
    if (sensors_)
      ConnectSensors();
    Describe();
    Write();
    for (long k = 0; k < steps;)
    {
      Once(k * dt);
      long next = std::min(steps, (k / chunk + 1) * static_cast<long>(chunk));
      for (const auto& deed : deeds_)
        if (long at = std::lround(deed.from / dt); !deed.done && at > k)
          next = std::min(next, at);
      world_->Step(next - k);
      k = next;
      if (k % chunk == 0)
      {
        elapsed_ = k * dt;
        if (sensors_)
          std::this_thread::sleep_for(std::chrono::milliseconds(20));  // they are measured in other threads
        Write();
      }
    }
    Describe();
    std::fprintf(file_, "end,%.6g\n", seconds_);
    std::fclose(file_);
    std::_Exit(0);
  }

  bool Ready()
  {
    if (!world_->ModelCount())
      return true;
    return !sensors_ || (sensors::SensorManager::Instance()->SensorsInitialized() &&
                         !sensors::SensorManager::Instance()->GetSensors().empty());
  }

  // The server makes and deletes models between two steps, in its own thread.
  template <class Condition>
  void WaitFor(Condition met)
  {
    for (int i = 0; i < 500 && !met(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }

  physics::JointPtr Joint(const std::string& scoped)
  {
    const auto cut = scoped.rfind("::");
    auto model = world_->ModelByName(scoped.substr(0, cut));
    return model ? model->GetJoint(scoped.substr(cut + 2)) : nullptr;
  }

  physics::LinkPtr Link(const std::string& scoped)
  {
    return boost::dynamic_pointer_cast<physics::Link>(world_->EntityByName(scoped));
  }

  // What lasts: forces that are given anew in each step.
  void Apply()
  {
    const double t = steps_++ * world_->Physics()->GetMaxStepSize();
    for (const auto& deed : deeds_)
    {
      if (t < deed.from - 1e-9 || t >= deed.until - 1e-9)
        continue;
      if (deed.kind == "effort")
      {
        if (auto joint = Joint(deed.on))
          joint->SetForce(deed.values.size() > 1 ? static_cast<unsigned>(deed.values[1]) : 0, deed.values[0]);
      }
      else if (deed.kind == "push")
      {
        if (auto link = Link(deed.on))
          link->AddForce(Vector3d(deed.values[0], deed.values[1], deed.values[2]));
      }
      else if (deed.kind == "torque")
      {
        if (auto link = Link(deed.on))
          link->AddTorque(Vector3d(deed.values[0], deed.values[1], deed.values[2]));
      }
      else if (deed.kind == "pd")
      {  // target, P, D: what a controller by effort does
        if (auto joint = Joint(deed.on))
          joint->SetForce(0, deed.values[1] * (deed.values[0] - joint->Position(0)) - deed.values[2] * joint->GetVelocity(0));
      }
      else if (deed.kind == "velocity")
      {
        if (auto joint = Joint(deed.on))
          joint->SetVelocity(0, deed.values[0]);
      }
    }
  }

  // What is done once, between two steps.
  void Once(double t)
  {
    for (auto& deed : deeds_)
    {
      if (deed.done || deed.from > t + 1e-9)
        continue;
      deed.done = true;
      const auto& v = deed.values;
      if (deed.kind == "motor")
      {  // speed, greatest effort
        if (auto joint = Joint(deed.on))
        {
          joint->SetParam("fmax", 0, v[1]);
          joint->SetParam("vel", 0, v[0]);
        }
      }
      else if (deed.kind == "pose")
      {
        if (auto model = world_->ModelByName(deed.on))
          model->SetWorldPose(Pose3d(v[0], v[1], v[2], v[3], v[4], v[5]));
      }
      else if (deed.kind == "twist")
      {
        if (auto model = world_->ModelByName(deed.on))
        {
          model->SetLinearVel(Vector3d(v[0], v[1], v[2]));
          model->SetAngularVel(Vector3d(v[3], v[4], v[5]));
        }
      }
      else if (deed.kind == "position")
      {
        if (auto joint = Joint(deed.on))
          joint->SetPosition(0, v[0]);
      }
      else if (deed.kind == "reset")
      {
        world_->Reset();
      }
      else if (deed.kind == "reset_poses")
      {
        world_->ResetEntities(physics::Base::MODEL);
      }
      else if (deed.kind == "remove")
      {
        world_->RemoveModel(deed.on);
        WaitFor([&] { return !world_->ModelByName(deed.on); });
      }
      else if (deed.kind == "gravity")
      {
        if (auto link = Link(deed.on))
          link->SetGravityMode(v[0] > 0);
      }
      else if (deed.kind == "world_gravity")
      {
        world_->SetGravity(Vector3d(v[0], v[1], v[2]));
      }
      else if (deed.kind == "kinematic")
      {
        if (auto link = Link(deed.on))
          link->SetKinematic(v[0] > 0);
      }
      else if (deed.kind == "spawn")
      {
        std::ifstream file(deed.on);
        std::stringstream text;
        text << file.rdbuf();
        const auto before = world_->ModelCount();
        world_->InsertModelString(text.str());
        WaitFor([&] { return world_->ModelCount() > before; });
      }
    }
  }

  // ---------------------------------------------------------------------------------------------------- rows

  // Some names begin with the world's.
  std::string Short(const std::string& name) const
  {
    const std::string prefix = world_->Name() + "::";
    return name.compare(0, prefix.size(), prefix) ? name : name.substr(prefix.size());
  }

  void Row(const std::string& kind, const std::string& name, std::initializer_list<double> values)
  {
    std::fprintf(file_, "%s:%s,%.6g", kind.c_str(), name.c_str(), elapsed_);
    for (double value : values)
      std::fprintf(file_, ",%.7g", value);
    std::fputc('\n', file_);
  }

  void WriteMotion(const std::string& kind, const std::string& name, physics::EntityPtr entity)
  {
    const auto pose = entity->WorldPose();
    const auto v = entity->WorldLinearVel(), w = entity->WorldAngularVel();
    Row(kind, name,
        { pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z(), pose.Rot().W(), v.X(),
          v.Y(), v.Z(), w.X(), w.Y(), w.Z() });
  }

  void WriteModel(physics::ModelPtr model)
  {
    if (!model->IsStatic())
    {
      WriteMotion("model", Short(model->GetScopedName()), model);
      if (links_)
        for (const auto& link : model->GetLinks())
          WriteMotion("link", Short(link->GetScopedName()), link);
      for (const auto& joint : model->GetJoints())
        WriteJoint(model, joint);
    }
    for (const auto& inner : model->NestedModels())
      WriteModel(inner);
  }

  void WriteJoint(physics::ModelPtr model, physics::JointPtr joint)
  {
    const std::string name = Short(model->GetScopedName()) + "::" + joint->GetName();
    for (unsigned axis = 0; axis < joint->DOF(); ++axis)
      Row(axis ? "joint" + std::to_string(axis) : "joint", name, { joint->Position(axis), joint->GetVelocity(axis) });
    if (!wrenches_)
      return;
    const auto w = joint->GetForceTorque(0u);
    Row("wrench", name,
        { w.body1Force.X(), w.body1Force.Y(), w.body1Force.Z(), w.body1Torque.X(), w.body1Torque.Y(), w.body1Torque.Z(),
          w.body2Force.X(), w.body2Force.Y(), w.body2Force.Z(), w.body2Torque.X(), w.body2Torque.Y(), w.body2Torque.Z() });
  }

  void Write()
  {
    for (const auto& model : world_->Models())
      WriteModel(model);
    if (contacts_)
    {
      const auto* manager = world_->Physics()->GetContactManager();
      for (unsigned i = 0; i < manager->GetContactCount(); ++i)
        WriteContact(*manager->GetContacts()[i]);
    }
    if (sensors_)
    {
      std::lock_guard<std::mutex> lock(mutex_);
      for (const auto& entry : heard_)
        std::fprintf(file_, "sensor:%s,%.6g%s\n", entry.first.c_str(), elapsed_, entry.second.c_str());
      heard_.clear();
    }
    std::fflush(file_);
  }

  void WriteContact(const physics::Contact& contact)
  {
    if (!contact.collision1 || !contact.collision2)
      return;
    const std::string pair = Short(contact.collision1->GetScopedName()) + "|" + Short(contact.collision2->GetScopedName());
    for (int i = 0; i < contact.count; ++i)
      Row("contact", pair,
          { contact.positions[i].X(), contact.positions[i].Y(), contact.positions[i].Z(), contact.normals[i].X(),
            contact.normals[i].Y(), contact.normals[i].Z(), contact.depths[i], contact.wrench[i].body1Force.X(),
            contact.wrench[i].body1Force.Y(), contact.wrench[i].body1Force.Z(), contact.wrench[i].body1Torque.X(),
            contact.wrench[i].body1Torque.Y(), contact.wrench[i].body1Torque.Z() });
  }

  // ---------------------------------------------------------------------------------------------------- what Gazebo made of the file

  void Describe()
  {
    for (const auto& model : world_->Models())
      DescribeModel(model);
  }

  void DescribeModel(physics::ModelPtr model)
  {
    const auto pose = model->WorldPose();
    std::fprintf(file_, "is_model:%s,%.6g,%d,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g\n", Short(model->GetScopedName()).c_str(),
                 elapsed_, model->IsStatic(), pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z(), pose.Rot().X(), pose.Rot().Y(),
                 pose.Rot().Z(), pose.Rot().W());
    for (const auto& link : model->GetLinks())
    {
      const auto i = link->GetInertial();
      const auto at = link->WorldPose();
      const auto c = i->CoG(), d = i->PrincipalMoments(), p = i->ProductsOfInertia();
      std::fprintf(file_,
                   "is_link:%s,%.6g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%d\n",
                   Short(link->GetScopedName()).c_str(), elapsed_, i->Mass(), c.X(), c.Y(), c.Z(), d.X(), d.Y(), d.Z(), p.X(),
                   p.Y(), p.Z(), at.Pos().X(), at.Pos().Y(), at.Pos().Z(), at.Rot().X(), at.Rot().Y(), at.Rot().Z(),
                   at.Rot().W(), link->GetGravityMode());
      for (const auto& collision : link->GetCollisions())
        std::fprintf(file_, "is_collision:%s,%.6g\n", Short(collision->GetScopedName()).c_str(), elapsed_);
    }
    for (const auto& joint : model->GetJoints())
    {
      std::fprintf(file_, "is_joint:%s::%s,%.6g,%s,%s,%u", Short(model->GetScopedName()).c_str(), joint->GetName().c_str(),
                   elapsed_, joint->GetParent() ? joint->GetParent()->GetName().c_str() : "world",
                   joint->GetChild() ? joint->GetChild()->GetName().c_str() : "world", joint->DOF());
      for (unsigned a = 0; a < joint->DOF(); ++a)
      {
        const auto x = joint->GlobalAxis(a);
        std::fprintf(file_, ",%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g,%.7g", x.X(), x.Y(), x.Z(), joint->LowerLimit(a),
                     joint->UpperLimit(a), joint->GetEffortLimit(a), joint->GetVelocityLimit(a), joint->GetDamping(a));
      }
      std::fputc('\n', file_);
    }
    for (const auto& inner : model->NestedModels())
      DescribeModel(inner);
  }

  // ---------------------------------------------------------------------------------------------------- sensors

  void Hear(const std::string& name, const common::Time& time, const std::vector<double>& values, const std::string& words = "")
  {
    std::ostringstream line;
    line.precision(7);
    line << "," << time.Double();
    for (double value : values)
      line << "," << value;
    if (!words.empty())
      line << "," << words;
    std::lock_guard<std::mutex> lock(mutex_);
    heard_[name] = line.str();
  }

  void ConnectSensors()
  {
    for (const auto& sensor : sensors::SensorManager::Instance()->GetSensors())
    {
      sensor->SetActive(true);
      auto* raw = sensor.get();
      connections_.push_back(sensor->ConnectUpdated([this, raw] { Measure(raw); }));
    }
  }

  void Measure(sensors::Sensor* sensor)
  {
    const std::string name = Short(sensor->ScopedName());
    const auto time = sensor->LastMeasurementTime();
    if (auto* ray = dynamic_cast<sensors::RaySensor*>(sensor))
    {
      std::vector<double> ranges;
      ray->Ranges(ranges);
      Hear(name, time, ranges);
    }
    else if (auto* imu = dynamic_cast<sensors::ImuSensor*>(sensor))
    {
      const auto q = imu->Orientation();
      const auto w = imu->AngularVelocity(), a = imu->LinearAcceleration();
      Hear(name, time, { q.X(), q.Y(), q.Z(), q.W(), w.X(), w.Y(), w.Z(), a.X(), a.Y(), a.Z() });
    }
    else if (auto* scale = dynamic_cast<sensors::ForceTorqueSensor*>(sensor))
    {
      const auto f = scale->Force(), t = scale->Torque();
      Hear(name, time, { f.X(), f.Y(), f.Z(), t.X(), t.Y(), t.Z() });
    }
    else if (auto* altimeter = dynamic_cast<sensors::AltimeterSensor*>(sensor))
    {
      Hear(name, time, { altimeter->Altitude(), altimeter->VerticalVelocity(), altimeter->ReferenceAltitude() });
    }
    else if (auto* magnetometer = dynamic_cast<sensors::MagnetometerSensor*>(sensor))
    {
      const auto b = magnetometer->MagneticField();
      Hear(name, time, { b.X(), b.Y(), b.Z() });
    }
    else if (auto* gps = dynamic_cast<sensors::GpsSensor*>(sensor))
    {
      Hear(name, time,
           { gps->Latitude().Degree(), gps->Longitude().Degree(), gps->Altitude(), gps->VelocityEast(), gps->VelocityNorth(),
             gps->VelocityUp() });
    }
    else if (auto* sonar = dynamic_cast<sensors::SonarSensor*>(sensor))
    {
      Hear(name, time, { sonar->Range() });
    }
    else if (auto* contact = dynamic_cast<sensors::ContactSensor*>(sensor))
    {
      MeasureContact(name, time, contact);
    }
    else if (auto* logical = dynamic_cast<sensors::LogicalCameraSensor*>(sensor))
    {
      const auto image = logical->Image();
      for (int i = 0; i < image.model_size(); ++i)
      {
        const auto pose = msgs::ConvertIgn(image.model(i).pose());
        Hear(
            name + "." + Short(image.model(i).name()), time,
            { pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z(), pose.Rot().W() });
      }
    }
  }

  void MeasureContact(const std::string& name, const common::Time& time, sensors::ContactSensor* sensor)
  {
    const auto contacts = sensor->Contacts();
    for (int i = 0; i < contacts.contact_size(); ++i)
    {
      const auto& contact = contacts.contact(i);
      std::vector<double> values;
      for (int k = 0; k < contact.position_size(); ++k)
      {
        const auto p = msgs::ConvertIgn(contact.position(k)), n = msgs::ConvertIgn(contact.normal(k));
        const auto f = msgs::ConvertIgn(contact.wrench(k).body_1_wrench().force());
        values.insert(values.end(), { p.X(), p.Y(), p.Z(), n.X(), n.Y(), n.Z(), contact.depth(k), f.X(), f.Y(), f.Z() });
      }
      Hear(name + "." + Short(contact.collision1()) + "|" + Short(contact.collision2()), time, values);
    }
  }

  physics::WorldPtr world_;
  std::FILE* file_ = nullptr;
  double seconds_ = 1, every_ = 0.01, elapsed_ = 0;
  long steps_ = 0;
  bool contacts_ = false, wrenches_ = false, links_ = false, sensors_ = false;
  std::vector<Deed> deeds_;
  event::ConnectionPtr begin_;
  std::vector<event::ConnectionPtr> connections_;
  std::mutex mutex_;
  std::map<std::string, std::string> heard_;
  std::thread thread_;
};

GZ_REGISTER_WORLD_PLUGIN(Recorder)
