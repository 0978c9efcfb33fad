// Robots of standard input, each ended by a zero byte, as urdfdom reads them: one JSON line for each, null where it refuses.
#include <console_bridge/console.h>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <string>
#include <urdf_parser/urdf_parser.h>

namespace {
std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string link(const urdf::Link& link) {
  const urdf::Inertial none, &i = link.inertial ? *link.inertial : none;
  std::string out = "{\"inertial\":[";
  for (double value :
       {i.mass, i.ixx, i.ixy, i.ixz, i.iyy, i.iyz, i.izz, i.origin.position.x, i.origin.position.y, i.origin.position.z})
    out += (out.back() == '[' ? "" : ",") + number(link.inertial ? value : 0.0);
  return out + "],\"visuals\":" + std::to_string(link.visual_array.size()) +
         ",\"collisions\":" + std::to_string(link.collision_array.size()) + "}";
}

std::string joint(const urdf::Joint& joint) {
  std::string out = "{\"axis\":[" + number(joint.axis.x) + "," + number(joint.axis.y) + "," + number(joint.axis.z) + "]";
  if (joint.limits)
    out += ",\"limit\":[" + number(joint.limits->lower) + "," + number(joint.limits->upper) + "," +
           number(joint.limits->effort) + "," + number(joint.limits->velocity) + "]";
  if (joint.mimic) out += ",\"mimic\":[" + number(joint.mimic->multiplier) + "," + number(joint.mimic->offset) + "]";
  return out + "}";
}
}  // namespace

int main() {
  console_bridge::noOutputHandler();
  const std::string input((std::istreambuf_iterator<char>(std::cin)), {});
  for (std::size_t at = 0; at < input.size();) {
    const std::string text = input.substr(at, input.find('\0', at) - at);
    at += text.size() + 1;
    const urdf::ModelInterfaceSharedPtr robot = urdf::parseURDF(text);
    std::string links, joints;
    if (robot) {
      for (const auto& [name, part] : robot->links_) links += (links.empty() ? "\"" : ",\"") + name + "\":" + link(*part);
      for (const auto& [name, part] : robot->joints_) joints += (joints.empty() ? "\"" : ",\"") + name + "\":" + joint(*part);
    }
    std::cout << (robot ? "{\"links\":{" + links + "},\"joints\":{" + joints + "}}" : "null") << "\n";
  }
}
