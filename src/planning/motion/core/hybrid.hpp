#pragma once

#include <ompl/base/ProblemDefinition.h>

namespace motion
{
/// Add the path of the best parts of all exact solutions of `problem`, led over from one to another where that is valid.
void hybridize(const ompl::base::SpaceInformationPtr& space, ompl::base::ProblemDefinition& problem);
}  // namespace motion
