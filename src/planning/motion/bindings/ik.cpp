#include "motion/ik.hpp"

#include "motion/constraints.hpp"

#include "casters.hpp"

namespace motion
{
void bindIk(py::module_& m)
{
  m.def("_ik",
        [](const RobotState& seed, const std::string& group, const std::vector<std::pair<std::string, Transform>>& poses,
           double timeout, double tolerance, bool position_only, std::size_t solutions, int max_restarts, bool approximate,
           const std::optional<Array>& consistency, const py::object& valid_object, std::uint64_t random_seed,
           const PlanningScene* collisions, const PlanningScene* scene, const Constraints* constraints) {
          const JointModelGroup& g = seed.model()->group(group);
          std::optional<std::function<bool(Array)>> valid;
          if (!valid_object.is_none())
            valid = valid_object.cast<std::function<bool(Array)>>();
          std::vector<IkTarget> targets;
          for (const auto& [link, pose] : poses)
            targets.push_back({seed.model()->link(link).index, pose, true, !position_only});
          IkOptions options;
          options.timeout = timeout;
          options.tolerance = tolerance;
          options.solutions = solutions;
          options.max_restarts = max_restarts;
          options.return_approximate = approximate;
          options.random_seed = random_seed;
          if (consistency)
            options.consistency = fromArray(*consistency, g.size(), "consistency limits");
          std::optional<CollisionFree> free;
          std::optional<ConstraintSet> kept;
          if (collisions)
            free.emplace(*collisions, seed, group);
          if (constraints)
            kept.emplace(*scene, *constraints);
          RobotState at = seed;
          if (valid || free || kept)
            options.valid = [&](const double* values) {
              at.setGroup(g, values);
              if ((kept && !kept->satisfied(at)) || (free && !(*free)(at)))
                return false;
              if (!valid)
                return true;
              py::gil_scoped_acquire lock;
              return (*valid)(toArray(std::vector<double>(values, values + g.size())));
            };
          IkResult result;
          {
            py::gil_scoped_release release;
            result = IkSolver(seed.model(), g).solve(seed, targets, options);
          }
          py::dict out;
          out["solutions"] = toArray(result.solutions, g.size());
          out["approximate"] = result.approximate;
          out["error"] = result.error;
          out["iterations"] = result.iterations;
          out["restarts"] = result.restarts;
          out["rejected"] = result.rejected;
          out["time"] = result.time;
          return out;
        });
}
}  // namespace motion
