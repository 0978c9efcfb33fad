#include "schema.hpp"

#include <map>
#include <sstream>

namespace sdf
{
inline namespace v12
{
namespace internal
{
namespace
{

// One element a line, those inside of it further in: name, ! where it is always there, type and default of its value; attributes have @.
// An element in first column is looked up by those that only name it.
const char* const table = R"(
sdf @version!=string:1.9
  world
  model
  light
world @name!=string:__default__
  gravity! vector3 0 0 -9.8
  magnetic_field! vector3 5.5645e-6 22.8758e-6 -42.3884e-6
  atmosphere! @type!=string:adiabatic
    temperature double 288.15
    temperature_gradient double -0.0065
    pressure double 101325
  physics!
  scene!
    ambient! color 0.4 0.4 0.4 1.0
    background! color .7 .7 .7 1
    shadows! bool true
    grid bool true
    origin_visual bool true
  wind
    linear_velocity vector3 0 0 0
  spherical_coordinates
    surface_model! string EARTH_WGS84
    latitude_deg! double 0.0
    longitude_deg! double 0.0
    elevation! double 0.0
    heading_deg! double 0.0
  model
  light
  plugin
  frame
physics @name=string:default_physics @default=bool:false @type!=string:ode
  max_step_size! double 0.001
  real_time_factor! double 1.0
  real_time_update_rate! double 1000
  max_contacts int 20
  ode
    solver!
      type! string quick
      min_step_size double 0.0001
      iters! int 50
      precon_iters int 0
      sor! double 1.3
      use_dynamic_moi_rescaling! bool false
      friction_model string pyramid_model
    constraints!
      cfm! double 0
      erp! double 0.2
      contact_max_correcting_vel! double 100.0
      contact_surface_layer! double 0.001
model @name!=string:__default__ @canonical_link=string: @placement_frame=string:
  static bool false
  self_collide bool false
  allow_auto_disable bool true
  enable_wind bool false
  pose
  model
  frame
  link
  joint
  plugin
pose pose 0 0 0 0 0 0 @relative_to=string: @rotation_format=string:euler_rpy @degrees=bool:false
frame @name!=string: @attached_to=string:
  pose
plugin @name!=string:__default__ @filename!=string:__default__
link @name!=string:__default__
  gravity bool true
  enable_wind bool false
  self_collide bool false
  kinematic bool false
  must_be_base_link bool false
  velocity_decay
    linear double 0.0
    angular double 0.0
  pose
  inertial
    mass double 1.0
    pose
    inertia
      ixx! double 1.0
      ixy! double 0.0
      ixz! double 0.0
      iyy! double 1.0
      iyz! double 0.0
      izz! double 1.0
  collision
  visual
  sensor
  light
  battery @name!=string:__default__
    voltage! double 0.0
collision @name!=string:__default__
  laser_retro double 0
  max_contacts int 10
  pose
  geometry!
  surface
    bounce
      restitution_coefficient double 0
      threshold double 100000
    friction
      torsional
        coefficient double 1.0
        use_patch_radius bool true
        patch_radius double 0
        surface_radius double 0
        ode
          slip double 0.0
      ode
        mu double 1
        mu2 double 1
        fdir1 vector3 0 0 0
        slip1 double 0.0
        slip2 double 0.0
    contact
      collide_without_contact bool false
      collide_without_contact_bitmask unsigned_int 1
      collide_bitmask unsigned_int 65535
      category_bitmask unsigned_int 65535
      poissons_ratio double 0.3
      elastic_modulus double -1
      ode
        soft_cfm double 0
        soft_erp double 0.2
        kp double 1000000000000.0
        kd double 1.0
        max_vel double 0.01
        min_depth double 0
visual @name!=string:__default__
  cast_shadows bool true
  laser_retro double 0.0
  transparency double 0.0
  visibility_flags unsigned_int 4294967295
  meta
    layer int 0
  pose
  material
    script
      uri! string __default__
      name! string __default__
    lighting bool true
    ambient color 0 0 0 1
    diffuse color 0 0 0 1
    specular color 0 0 0 1
    emissive color 0 0 0 1
  geometry!
  plugin
geometry
  empty
  box
    size! vector3 1 1 1
  cylinder
    radius! double 1
    length! double 1
  capsule
    radius! double 0.5
    length! double 1
  sphere
    radius! double 1
  plane
    normal! vector3 0 0 1
    size! vector2d 1 1
  mesh
    uri! string __default__
    submesh
      name! string __default__
      center bool false
    scale vector3 1 1 1
joint @name!=string:__default__ @type!=string:__default__
  parent! string __default__
  child! string __default__
  gearbox_ratio double 1.0
  gearbox_reference_body string __default__
  thread_pitch double 1.0
  pose
  axis
  axis2
  physics
    provide_feedback bool false
    ode
      provide_feedback bool false
      cfm_damping bool false
      implicit_spring_damper bool false
      fudge_factor double 0
      cfm double 0
      erp double 0.2
      bounce double 0
      max_force double 0
      velocity double 0
      limit
        cfm! double 0.0
        erp! double 0.2
      suspension
        cfm! double 0.0
        erp! double 0.2
  sensor
axis
  xyz! vector3 0 0 1 @expressed_in=string:
  dynamics
    damping double 0
    friction double 0
    spring_reference! double 0
    spring_stiffness! double 0
  limit!
    lower double -1e16
    upper double 1e16
    effort double inf
    velocity double inf
    stiffness double 1e8
    dissipation double 1.0
axis2 = axis
sensor @name!=string:__default__ @type!=string:__default__
  always_on bool false
  update_rate double 0
  visualize bool false
  topic string __default__
  pose
  plugin
  ray
  lidar
  camera
  contact
    collision! string __default__
    topic! string __default_topic__
  force_torque
    frame string child
    measure_direction string child_to_parent
    force
      x
        noise
      y
        noise
      z
        noise
    torque
      x
        noise
      y
        noise
      z
        noise
  imu
    orientation_reference_frame
      localization! string CUSTOM
    angular_velocity
      x
        noise
      y
        noise
      z
        noise
    linear_acceleration
      x
        noise
      y
        noise
      z
        noise
    enable_orientation bool true
  gps
    position_sensing
      horizontal
        noise
      vertical
        noise
    velocity_sensing
      horizontal
        noise
      vertical
        noise
  altimeter
    vertical_position
      noise
    vertical_velocity
      noise
  magnetometer
    x
      noise
    y
      noise
    z
      noise
ray
  scan!
    horizontal!
      samples! unsigned_int 640
      resolution! double 1
      min_angle! double 0
      max_angle! double 0
    vertical
      samples! unsigned_int 1
      resolution double 1
      min_angle! double 0
      max_angle! double 0
  range!
    min! double 0
    max! double 0
    resolution double 0
  noise
    type! string gaussian
    mean double 0.0
    stddev double 0.0
lidar = ray
noise @type!=string:none
  mean double 0.0
  stddev double 0.0
  bias_mean double 0.0
  bias_stddev double 0.0
  precision double 0.0
camera @name=string:__default__
  horizontal_fov! double 1.047
  image!
    width! int 320
    height! int 240
    format string R8G8B8
  clip!
    near! double .1
    far! double 100
  noise
    type! string gaussian
    mean double 0.0
    stddev double 0.0
light @name!=string:__default__ @type!=string:point
  cast_shadows bool false
  diffuse color 1 1 1 1
  specular color .1 .1 .1 1
  attenuation
    range! double 10
    linear double 1
    constant double 1
    quadratic double 0
  direction! vector3 0 0 -1
  pose
  plugin
)";

typedef std::map<std::string, Description*> Named;

struct Line
{
  std::size_t depth = 0;
  std::string name, same_as;
  bool required = false;
  Description* made = nullptr;
};

void add_attribute(Description& to, const std::string& word)
{
  const std::size_t equals = word.find('='), colon = word.find(':', equals);
  const bool required = word[equals - 1] == '!';
  to.attributes.push_back(
      { word.substr(1, equals - 1 - required), word.substr(equals + 1, colon - equals - 1), word.substr(colon + 1), required });
}

/// Descriptions live as long as the process.
Line read(const std::string& text)
{
  Line line;
  line.depth = text.find_first_not_of(' ') / 2;
  line.made = new Description();
  std::istringstream words(text);
  words >> line.name;
  line.required = line.name.back() == '!';
  if (line.required)
    line.name.pop_back();
  line.made->name = line.name;
  line.made->required = line.required;
  for (std::string word; words >> word;)
    if (word[0] == '@')
      add_attribute(*line.made, word);
    else if (word == "=")
      words >> line.same_as;
    else if (line.made->type.empty())
      line.made->type = word == "unsigned_int" ? "unsigned int" : word;
    else
      line.made->fallback += (line.made->fallback.empty() ? "" : " ") + word;
  return line;
}

Named load()
{
  Named roots;
  std::vector<Line> above, aliases;
  std::vector<Description*> bare;  // those that only name one of the first column
  std::istringstream lines(table);
  for (std::string text; std::getline(lines, text);)
  {
    if (text.empty())
      continue;
    const Line line = read(text);
    above.resize(line.depth);
    if (line.depth == 0 && line.same_as.empty())
      roots[line.name] = line.made;
    else if (line.depth == 0)
      aliases.push_back(line);
    else
    {
      above.back().made->children.push_back(line.made);
      bare.push_back(line.made);
    }
    above.push_back(line);
  }
  for (const Line& line : aliases)
  {
    *line.made = *roots.at(line.same_as);
    line.made->name = line.name;
    roots[line.name] = line.made;
  }
  for (Description* each : bare)
    if (each->type.empty() && each->children.empty() && each->attributes.empty() && roots.count(each->name))
    {
      const bool required = each->required;
      *each = *roots[each->name];
      each->required = required;
    }
  return roots;
}

}  // namespace

const Description* Description::child(const std::string& tag) const
{
  for (const Description* each : children)
    if (each->name == tag)
      return each;
  return nullptr;
}

const Description* described(const std::string& name)
{
  static const Named roots = load();
  const auto found = roots.find(name);
  return found == roots.end() ? nullptr : found->second;
}

}  // namespace internal
}  // namespace v12
}  // namespace sdf
