// What FCL alone costs: pairs of shapes at given poses in a plain loop that ends at the first touch. Reads from standard input
// the bodies (box x y z, cylinder radius length, sphere radius, mesh: vertices and triangles), the pairs, and the states: a 3x4
// pose for each body; counts come first.
// Prints microseconds of processor time per state, and how many states touch. usage: bare_fcl ROUNDS
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

using Pose = fcl::Transform3d;

static double now()
{
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}

static std::shared_ptr<fcl::CollisionGeometryd> body(std::istream& in)
{
  std::string kind;
  double x, y, z;
  in >> kind;
  if (kind == "box" && in >> x >> y >> z)
    return std::make_shared<fcl::Boxd>(x, y, z);
  if (kind == "cylinder" && in >> x >> y)
    return std::make_shared<fcl::Cylinderd>(x, y);
  if (kind == "sphere" && in >> x)
    return std::make_shared<fcl::Sphered>(x);
  std::size_t vertices, triangles;
  in >> vertices >> triangles;
  std::vector<fcl::Vector3d> points(vertices);
  std::vector<fcl::Triangle> faces(triangles);
  for (auto& p : points)
    in >> p[0] >> p[1] >> p[2];
  for (auto& f : faces)
    in >> f[0] >> f[1] >> f[2];
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  model->beginModel();
  model->addSubModel(points, faces);
  model->endModel();
  return model;
}

int main(int argc, char** argv)
{
  if (argc < 2)
    return 2;
  std::ios::sync_with_stdio(false);
  std::size_t bodies, pairs, states;
  std::cin >> bodies;
  std::vector<std::shared_ptr<fcl::CollisionGeometryd>> shapes;
  for (std::size_t i = 0; i < bodies; ++i)
    shapes.push_back(body(std::cin));
  std::cin >> pairs;
  std::vector<std::pair<int, int>> list(pairs);
  for (auto& pair : list)
    std::cin >> pair.first >> pair.second;
  std::cin >> states;
  std::vector<Pose, Eigen::aligned_allocator<Pose>> poses(states * bodies, Pose::Identity());
  for (auto& pose : poses)
    for (int i = 0; i < 12; ++i)
      std::cin >> pose.matrix()(i / 4, i % 4);
  if (!std::cin)
    return 3;
  const fcl::CollisionRequestd request(1, false);
  double best = 1e9;
  std::size_t touching = 0;
  for (int round = 0; round < std::atoi(argv[1]); ++round)
  {
    touching = 0;
    const double start = now();
    for (std::size_t s = 0; s < states; ++s)
    {
      const Pose* at = &poses[s * bodies];
      for (const auto& pair : list)
      {
        fcl::CollisionResultd result;
        if (fcl::collide(shapes[pair.first].get(), at[pair.first], shapes[pair.second].get(), at[pair.second], request, result))
        {
          ++touching;
          break;
        }
      }
    }
    best = std::min(best, (now() - start) / states * 1e6);
  }
  std::printf("%.4f %zu\n", best, touching);
}
