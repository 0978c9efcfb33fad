// Pipelines with compiled planners and adapters for Python programs. Scenes, requests and answers go as messages.
#include <moveit/kinematics_plugin_loader/kinematics_plugin_loader.h>
#include <moveit/planning_pipeline/planning_pipeline.h>
#include <moveit_msgs/MotionPlanResponse.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <mutex>

#include "message_bytes.hpp"
#include "motion/robot_model.hpp"
#include "second_node.hpp"

namespace py = pybind11;

namespace
{
class CompiledPipeline
{
public:
  CompiledPipeline(const std::shared_ptr<motion::RobotModel>& robot, const std::string& urdf, const std::string& srdf,
                   const std::string& description, const std::string& pipeline)
  {
    const auto urdf_model = std::make_shared<urdf::Model>();
    const auto srdf_model = std::make_shared<srdf::Model>();
    if (!urdf_model->initString(urdf) || !srdf_model->initString(*urdf_model, srdf))
      throw std::runtime_error("the robot's description cannot be read");
    model_ = std::make_shared<moveit::core::RobotModel>(robot, urdf_model, srdf_model);
    kinematics_ = std::make_shared<kinematics_plugin_loader::KinematicsPluginLoader>(description);
    const moveit::core::SolverAllocatorFn allocator = kinematics_->getLoaderFunction(srdf_model);
    std::map<std::string, moveit::core::SolverAllocatorFn> by_group;
    for (const std::string& name : kinematics_->getKnownGroups())
      if (model_->hasJointModelGroup(name))
        by_group[name] = allocator;
    model_->setKinematicsAllocators(by_group);
    pipeline_ = std::make_unique<planning_pipeline::PlanningPipeline>(model_, ros::NodeHandle(pipeline));
    pipeline_->displayComputedMotionPlans(false);  // who uses this shows them
    if (!pipeline_->getPlannerManager())
      throw std::runtime_error("planner '" + pipeline_->getPlannerPluginName() +
                               "' could not be loaded or initialized; the lines above say why");
  }

  std::string description() const { return pipeline_->getPlannerManager()->getDescription(); }

  std::vector<std::string> algorithms() const
  {
    std::vector<std::string> names;
    pipeline_->getPlannerManager()->getPlanningAlgorithms(names);
    return names;
  }

  // (the MotionPlanResponse, way points that adapters have added)
  std::pair<py::bytes, std::vector<std::size_t>> generate(const std::string& scene_bytes, const std::string& request_bytes)
  {
    moveit_msgs::MotionPlanResponse message;
    std::vector<std::size_t> added;
    {
      py::gil_scoped_release release;
      std::lock_guard<std::mutex> lock(one_at_a_time_);  // planners keep scratch data
      const auto scene = std::make_shared<planning_scene::PlanningScene>(model_);
      scene->setPlanningSceneMsg(read<moveit_msgs::PlanningScene>(scene_bytes));
      planning_interface::MotionPlanResponse response;
      const bool solved = pipeline_->generatePlan(scene, read<moveit_msgs::MotionPlanRequest>(request_bytes), response, added);
      response.getMessage(message);
      if (!solved && (message.error_code.val == moveit_msgs::MoveItErrorCodes::SUCCESS || message.error_code.val == 0))
        message.error_code.val = moveit_msgs::MoveItErrorCodes::PLANNING_FAILED;
    }
    return { py::bytes(written(message)), added };
  }

  void terminate() const
  {
    py::gil_scoped_release release;
    pipeline_->terminate();
  }

private:
  moveit::core::RobotModelPtr model_;
  kinematics_plugin_loader::KinematicsPluginLoaderPtr kinematics_;
  std::unique_ptr<planning_pipeline::PlanningPipeline> pipeline_;
  std::mutex one_at_a_time_;
};
}  // namespace

PYBIND11_MODULE(_pipelines, m)
{
  m.doc() = "Pipelines with compiled planners (planning_interface::PlannerManager) and request adapters.";
  py::module_::import("motion");
  py::class_<CompiledPipeline>(m, "CompiledPipeline")
      .def(py::init([](const std::shared_ptr<motion::RobotModel>& robot, const std::string& urdf, const std::string& srdf,
                       const std::string& description, const std::string& pipeline, const std::string& node,
                       const std::string& master) {
             startSecondNode(node, master);
             py::gil_scoped_release release;
             return std::make_unique<CompiledPipeline>(robot, urdf, srdf, description, pipeline);
           }),
           py::arg("robot"), py::arg("urdf"), py::arg("srdf"), py::kw_only(), py::arg("description"), py::arg("pipeline"),
           py::arg("node"), py::arg("master"), "RuntimeError, one line: the planner cannot be used.")
      .def_property_readonly("description", &CompiledPipeline::description)
      .def_property_readonly("algorithms", &CompiledPipeline::algorithms)
      .def("generate", &CompiledPipeline::generate, py::arg("scene"), py::arg("request"),
           "Serialized PlanningScene and MotionPlanRequest in, (serialized MotionPlanResponse, indices added) out.")
      .def("terminate", &CompiledPipeline::terminate, "Ends what is being planned, from another thread.");
}
