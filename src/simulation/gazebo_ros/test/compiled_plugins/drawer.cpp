// A plugin of a visual, as others draw forces and paths: it builds, and is not loaded, as nothing draws.
#include <gazebo/common/Plugin.hh>
#include <gazebo/rendering/DynamicLines.hh>
#include <gazebo/rendering/RenderTypes.hh>
#include <gazebo/rendering/Scene.hh>
#include <gazebo/rendering/Visual.hh>

namespace gazebo
{

class Drawer : public VisualPlugin
{
public:
  ~Drawer() override { visual_->DeleteDynamicLine(line_); }

  void Load(rendering::VisualPtr visual, sdf::ElementPtr) override
  {
    visual_ = visual;
    line_ = visual_->CreateDynamicLine(rendering::RENDERING_LINE_STRIP);
    line_->AddPoint(ignition::math::Vector3d(0, 0, 0), ignition::math::Color(0, 1, 0, 1));
    line_->AddPoint(ignition::math::Vector3d(1, 1, 1));
    line_->setMaterial("Gazebo/Purple");
    line_->setVisibilityFlags(GZ_VISIBILITY_GUI);
    visual_->SetVisible(visual_->GetScene()->SimTime() > common::Time::Zero);
    update_ = event::Events::ConnectPreRender([this] { line_->SetPoint(1, visual_->WorldPose().Pos()); });
  }

private:
  rendering::VisualPtr visual_;
  rendering::DynamicLines* line_ = nullptr;
  event::ConnectionPtr update_;
};
GZ_REGISTER_VISUAL_PLUGIN(Drawer)

}  // namespace gazebo
