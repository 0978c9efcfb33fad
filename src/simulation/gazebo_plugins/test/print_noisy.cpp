// print_noisy (imu|ray) NOISE NAME DT VALUE...: what the C++ face of <noise> makes of values, one a line, for test_noise.py.
#include <cstdio>
#include <cstdlib>

#include <gazebo/sensors/Noise.hh>

int main(int argc, char** argv)
{
  const std::string kind = argv[1];
  const std::string inside =
      kind == "imu" ? std::string("<imu><angular_velocity><x>") + argv[2] + "</x></angular_velocity></imu>"
                    : std::string(
                          "<ray><scan><horizontal><samples>1</samples><min_angle>0</min_angle><max_angle>0</max_angle>"
                          "</horizontal></scan><range><min>0</min><max>1</max></range>") +
                          argv[2] + "</ray>";
  sdf::SDFPtr document(new sdf::SDF());
  sdf::init(document);
  if (!sdf::readString("<sdf version='1.6'><model name='m'><link name='l'><sensor name='s' type='" + kind + "'>" + inside +
                           "</sensor></link></model></sdf>",
                       document))
    return 2;
  sdf::ElementPtr found = document->Root();
  for (const char* tag : { "model", "link", "sensor" })
    found = found->GetElement(tag);
  found = found->GetElement(kind);
  if (kind == "imu")
    found = found->GetElement("angular_velocity")->GetElement("x");
  const auto noise = gazebo::sensors::NoiseFactory::NewNoiseModel(found->GetElement("noise"));
  noise->Seed(argv[3]);
  for (int i = 5; i < argc; ++i)
    std::printf("%.17g\n", noise->Apply(std::atof(argv[i]), std::atof(argv[4])));
  return 0;
}
