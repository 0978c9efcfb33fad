// Upstream's class, driven from standard input; the command of each step goes to standard output.
//   pid p i d i_max i_min antiwindup   a new one
//   step error dt | slope error derivative dt | reset | past derivative integral
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>

#include <control_toolbox/pid.h>

namespace
{

double number(std::istream& in)
{
  std::string text;
  in >> text;
  return std::strtod(text.c_str(), nullptr);  // also inf and nan
}

}  // namespace

int main()
{
  ros::Time::init();
  std::unique_ptr<control_toolbox::Pid> pid;
  for (std::string line; std::getline(std::cin, line);)
  {
    std::istringstream in(line);
    std::string word;
    in >> word;
    double n[6] = {};
    for (double& value : n)
      value = number(in);
    if (word == "pid")
    {
      pid.reset(new control_toolbox::Pid(n[0], n[1], n[2], n[3], n[4], n[5] != 0.0));
      std::puts("pid");
    }
    else if (word == "reset")
      pid->reset();
    else if (word == "past")
      pid->reset(n[0], n[1]);
    else
      std::printf("%a\n", word == "step" ? pid->computeCommand(n[0], ros::Duration(n[1]))
                                         : pid->computeCommand(n[0], n[1], ros::Duration(n[2])));
  }
}
