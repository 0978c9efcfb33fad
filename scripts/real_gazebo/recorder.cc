// Records what moves in a world of Gazebo Classic 11, as CSV lines in the file that TRUTH_OUT names. scripts/truth writes the
// <plugin> element of the scene into the world; its children say what is done and for how long:
//
//   <seconds>5</seconds> <every>0.01</every>     how long, and how often a row is written (simulated s)
//   <contacts>1</contacts> <wrenches>1</wrenches> <links>1</links> <sensors>1</sensors>   rows wanted besides those of models and joints
//   <timing>5000</timing>   no rows: instead the cost of so many steps, of making a model and of ending (see scripts/bench gazebo)
//   <do kind='...' on='model::joint' from='0' until='1' value='...'/>     see Apply() and Once()
//
// The server starts paused (gzserver -u). A thread of the plugin steps it, so that each deed lies between the same two steps in each run.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include <gazebo/common/common.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

#include "deeds.hh"
#include "sensor_rows.hh"
#include "timing.hh"

using namespace gazebo;

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
    deeds_.Read(world, sdf);
    timing_.Begin(world, file_, sdf->Get<int>("timing", 0).first);
    if (contacts_)
      world_->Physics()->GetContactManager()->SetNeverDropContacts(true);
    begin_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo&) { deeds_.Apply(); });
    thread_ = std::thread([this] { Run(); });
  }

private:
  void Run()
  {
    WaitFor([this] { return !sensors_ || SensorRows::Ready(); });
    if (sensors_)
      sensor_rows_.Connect(world_);
    if (timing_.Wanted())
    {
      deeds_.Once(0);
      timing_.Run();
      return;  // the server is ended from outside
    }
    RunRecorded();
    std::fprintf(file_, "end,%.6g\n", seconds_);
    std::fclose(file_);
    std::_Exit(0);
  }

  void RunRecorded()
  {
    const double dt = world_->Physics()->GetMaxStepSize();
    const long chunk = std::max(1L, std::lround(every_ / dt)), steps = std::lround(seconds_ / dt);
    Describe();
    Write();
    for (long k = 0; k < steps;)
    {
      deeds_.Once(k * dt);
      const long next = deeds_.Next(k, std::min(steps, (k / chunk + 1) * chunk), dt);
      world_->Step(static_cast<unsigned>(next - k));
      k = next;
      if (k % chunk)
        continue;
      elapsed_ = k * dt;
      if (sensors_)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));  // they are measured in other threads
      Write();
    }
    Describe();
  }

  std::string Short(const std::string& name) const { return ::Short(world_, name); }

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
      for (const auto& link : model->GetLinks())
        for (std::size_t i = 0; i < link->BatteryCount(); ++i)
          Row("battery", Short(link->GetScopedName()) + "::" + link->Battery(i)->Name(), { link->Battery(i)->Voltage() });
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
      sensor_rows_.Write(file_, elapsed_);
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

  physics::WorldPtr world_;
  std::FILE* file_ = nullptr;
  double seconds_ = 1, every_ = 0.01, elapsed_ = 0;
  bool contacts_ = false, wrenches_ = false, links_ = false, sensors_ = false;
  Deeds deeds_;
  SensorRows sensor_rows_;
  Timing timing_;
  event::ConnectionPtr begin_;
  std::thread thread_;
};

GZ_REGISTER_WORLD_PLUGIN(Recorder)
