// Colours and sizes.
#include <rviz_visual_tools/rviz_visual_tools.h>

#include "log_name.hpp"

namespace rviz_visual_tools {
namespace {

const double OPAQUE = -1;  // as setAlpha() says

struct Paint {
  double r, g, b, a;
};

// In the order of the enum, as far as a colour is fixed.
const std::array<Paint, 18> PAINTS = {{
    {0, 0, 0, OPAQUE},          // BLACK
    {0.597, 0.296, 0, OPAQUE},  // BROWN
    {0.1, 0.1, 0.8, OPAQUE},    // BLUE
    {0, 1, 1, OPAQUE},          // CYAN
    {0.9, 0.9, 0.9, OPAQUE},    // GREY
    {0.6, 0.6, 0.6, OPAQUE},    // DARK_GREY
    {0.1, 0.8, 0.1, OPAQUE},    // GREEN
    {0.6, 1, 0.2, OPAQUE},      // LIME_GREEN
    {1, 0, 1, OPAQUE},          // MAGENTA
    {1, 0.5, 0, OPAQUE},        // ORANGE
    {0.597, 0, 0.597, OPAQUE},  // PURPLE
    {0.8, 0.1, 0.1, OPAQUE},    // RED
    {1, 0.4, 1, OPAQUE},        // PINK
    {1, 1, 1, OPAQUE},          // WHITE
    {1, 1, 0, OPAQUE},          // YELLOW
    {0.1, 0.1, 0.1, 0.25},      // TRANSLUCENT
    {0.1, 0.1, 0.1, 0.1},       // TRANSLUCENT_LIGHT
    {0.1, 0.1, 0.1, 0.5},       // TRANSLUCENT_DARK
}};

struct Size {
  const char* name;
  double metres;
};

const std::array<Size, XXXXLARGE> SIZES = {{{"XXXXSMALL", 0.001},
                                            {"XXXSMALL", 0.0025},
                                            {"XXSMALL", 0.005},
                                            {"XSMALL", 0.0065},
                                            {"SMALL", 0.0075},
                                            {"MEDIUM", 0.01},
                                            {"LARGE", 0.025},
                                            {"XLARGE", 0.05},
                                            {"XXLARGE", 0.075},
                                            {"XXXLARGE", 0.1},
                                            {"XXXXLARGE", 0.5}}};

const Size& size(std::size_t scale) {
  if (scale < XXXXSMALL || scale > XXXXLARGE) throw std::runtime_error("Unknown size");
  return SIZES[scale - XXXXSMALL];
}

}  // namespace

const std::array<colors, 14> RvizVisualTools::ALL_RAND_COLORS = {RED,    GREEN, BLUE, GREY,       DARK_GREY, WHITE, ORANGE,
                                                                 YELLOW, BROWN, PINK, LIME_GREEN, PURPLE,    CYAN,  MAGENTA};

colors RvizVisualTools::getRandColor() { return ALL_RAND_COLORS[iRand(0, ALL_RAND_COLORS.size() - 1)]; }

std_msgs::ColorRGBA RvizVisualTools::getColor(colors color) const {
  if (color == RAND) return createRandColor();
  std_msgs::ColorRGBA result;
  if (color == CLEAR) {
    result.r = result.g = result.b = 1;
    return result;
  }
  if (color == DEFAULT)
    ROS_WARN_STREAM_NAMED(LOGNAME, "The 'DEFAULT' color should probably not be used with getColor(). Defaulting to blue.");
  const Paint& paint = PAINTS[static_cast<std::size_t>(color) < PAINTS.size() ? color : BLUE];
  result.r = paint.r;
  result.g = paint.g;
  result.b = paint.b;
  result.a = paint.a == OPAQUE ? alpha_ : paint.a;
  return result;
}

colors RvizVisualTools::intToRvizColor(std::size_t color) { return color <= DEFAULT ? static_cast<colors>(color) : DEFAULT; }

scales RvizVisualTools::intToRvizScale(std::size_t scale) {
  size(scale);
  return static_cast<scales>(scale);
}

std::string RvizVisualTools::scaleToString(scales scale) { return size(scale).name; }

std_msgs::ColorRGBA RvizVisualTools::createRandColor() const {
  std_msgs::ColorRGBA result;
  // Dark ones are hard to see; one attempt in two succeeds.
  for (int attempt = 0; attempt < 20 && result.r + result.g + result.b < 1.5; ++attempt) {
    result.r = fRand(0, 1);
    result.g = fRand(0, 1);
    result.b = fRand(0, 1);
  }
  result.a = alpha_;
  return result;
}

double RvizVisualTools::slerp(double start, double end, double range, double value) {
  return start + (end - start) / range * value;
}

std_msgs::ColorRGBA RvizVisualTools::getColorScale(double value) const {
  if (value < 0 || value > 1)
    ROS_WARN_STREAM_NAMED(
        LOGNAME, "Intensity value for color scale is " << (value < 0 ? "below" : "above") << " range [0,1], value: " << value);
  value = std::min(1.0, std::max(0.0, value));
  const bool lower = value <= 0.5;
  const std_msgs::ColorRGBA start = getColor(lower ? RED : YELLOW), end = getColor(lower ? YELLOW : GREEN);
  const double along = lower ? value : value - 0.5;
  std_msgs::ColorRGBA result;
  result.r = slerp(start.r, end.r, 0.5, along);
  result.g = slerp(start.g, end.g, 0.5, along);
  result.b = slerp(start.b, end.b, 0.5, along);
  result.a = alpha_;
  return result;
}

geometry_msgs::Vector3 RvizVisualTools::getScale(scales scale, double marker_scale) const {
  return cube(size(scale).metres * marker_scale);
}

geometry_msgs::Vector3 RvizVisualTools::cube(double edge) const {
  geometry_msgs::Vector3 result;
  result.x = result.y = result.z = edge * global_scale_;
  return result;
}

}  // namespace rviz_visual_tools
