#include <moveit/utils/robot_model_test_utils.h>

#include <ros/console.h>
#include <ros/package.h>

namespace moveit
{
namespace core
{
namespace
{
std::string fileOf(const std::string& robot_name, const std::string& kind)
{
  const bool pr2 = robot_name == "pr2";  // one package, other names of files
  const std::string package = "moveit_resources_" + robot_name + (kind == "urdf" || pr2 ? "_description" : "_moveit_config");
  const std::string path = ros::package::getPath(package);
  if (path.empty())
  {
    ROS_ERROR_NAMED("robot_model", "Package '%s' is not there: without it the robot '%s' cannot be loaded", package.c_str(),
                    robot_name.c_str());
    return "";
  }
  return pr2 ? path + "/" + kind + "/robot.xml" : path + (kind == "urdf" ? "/urdf/" : "/config/") + robot_name + "." + kind;
}
}  // namespace

urdf::ModelInterfaceSharedPtr loadModelInterface(const std::string& robot_name)
{
  const std::string file = fileOf(robot_name, "urdf");
  const auto model = std::make_shared<urdf::Model>();
  if (file.empty() || !model->initFile(file))
    return nullptr;
  return model;
}

srdf::ModelSharedPtr loadSRDFModel(const std::string& robot_name)
{
  const urdf::ModelInterfaceSharedPtr urdf_model = loadModelInterface(robot_name);
  const std::string file = urdf_model ? fileOf(robot_name, "srdf") : "";
  const auto model = std::make_shared<srdf::Model>();
  if (file.empty() || !model->initFile(*urdf_model, file))
    return nullptr;
  return model;
}

RobotModelPtr loadTestingRobotModel(const std::string& robot_name)
{
  const urdf::ModelInterfaceSharedPtr urdf_model = loadModelInterface(robot_name);
  const srdf::ModelSharedPtr srdf_model = urdf_model ? loadSRDFModel(robot_name) : nullptr;
  return srdf_model ? std::make_shared<RobotModel>(urdf_model, srdf_model) : nullptr;
}
}  // namespace core
}  // namespace moveit
