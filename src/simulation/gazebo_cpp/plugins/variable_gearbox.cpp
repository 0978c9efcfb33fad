// libVariableGearboxPlugin.so: a gearbox whose output is a smooth function of its input: cubic pieces between <x_y_dydx> (rad, rad,
// slope), straight on beyond the first and the last.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

#include <joint.hpp>

#include "named.hpp"

namespace gazebo
{

class VariableGearboxPlugin : public ModelPlugin
{
public:
  void Load(physics::ModelPtr model, sdf::ElementPtr sdf) override
  {
    gearbox_ = named_joint(*model, sdf, "gearbox_joint_name");
    if (!gearbox_->HasType(physics::Base::GEARBOX_JOINT))
      throw std::runtime_error("<gearbox_joint_name>: joint '" + gearbox_->GetName() + "' is not of type gearbox");
    input_ = turning(gearbox_->GetParent());
    output_ = turning(gearbox_->GetChild());
    for (sdf::ElementPtr each = sdf->HasElement("x_y_dydx") ? sdf->GetElement("x_y_dydx") : nullptr; each;
         each = each->GetNextElement("x_y_dydx"))
      add(each->Get<ignition::math::Vector3d>());
    if (knots_.empty())
      throw std::runtime_error("<x_y_dydx> is missing: give the input's angle, the output's, and the slope there");
    update_ = event::Events::ConnectWorldUpdateBegin([this](const common::UpdateInfo&) { OnUpdate(); });
  }

private:
  struct Knot
  {
    double x, y, slope;
  };

  void add(const ignition::math::Vector3d& knot)
  {
    if (!knot.IsFinite() || (!knots_.empty() && knot.X() <= knots_.back().x))
      throw std::runtime_error("<x_y_dydx>: the inputs' angles have to be finite and to grow from each to the next");
    knots_.push_back({ knot.X(), knot.Y(), knot.Z() });
  }

  // The hinge that the link turns on: the first joint whose child it is, but for the gearbox.
  physics::JointPtr turning(const physics::LinkPtr& link) const
  {
    if (link)
      for (const physics::JointPtr& joint : link->GetParentJoints())
        if (joint != gearbox_ && joint->DOF() > 0)
          return joint;
    throw std::runtime_error("link '" + (link ? link->GetName() : "world") +
                             "' of the gearbox is the child of no joint that turns: its angle is unknown");
  }

  // Of the output at an angle of the input, and the slope there.
  std::pair<double, double> at(double x) const
  {
    for (const Knot* end : { &knots_.front(), &knots_.back() })
      if (end == &knots_.front() ? x <= end->x : x >= end->x)
        return { end->y + end->slope * (x - end->x), end->slope };
    const auto next = std::upper_bound(knots_.begin(), knots_.end(), x, [](double a, const Knot& k) { return a < k.x; });
    const Knot &a = *(next - 1), &b = *next;
    const double h = b.x - a.x, t = (x - a.x) / h, u = 1 - t;
    const double y = u * u * ((1 + 2 * t) * a.y + t * h * a.slope) + t * t * ((1 + 2 * u) * b.y - u * h * b.slope);
    const double slope = 6 * t * u * (b.y - a.y) / h + u * (1 - 3 * t) * a.slope + t * (1 - 3 * u) * b.slope;
    return { y, slope };
  }

  // The gearbox as it is for this step: how far the output is off, and the ratio here. Its own angles are read again after the step.
  void OnUpdate()
  {
    const auto core = gearbox_->Core();
    const double x = input_->Position(0), y = output_->Position(0);
    if (!core || std::isnan(x) || std::isnan(y))
      return;
    const auto [wanted, slope] = at(x);
    core->gear_ratio = -slope;
    core->axes[0].q = y - wanted;
    core->axes[1].q = 0;
  }

  physics::JointPtr gearbox_, input_, output_;
  std::vector<Knot> knots_;
  event::ConnectionPtr update_;
};
GZ_REGISTER_MODEL_PLUGIN(VariableGearboxPlugin)

}  // namespace gazebo
