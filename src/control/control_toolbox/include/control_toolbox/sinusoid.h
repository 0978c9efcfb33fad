// A sine with its derivatives.
#pragma once

#include <cmath>
#include <cstdlib>

#include <ros/console.h>
#include <tinyxml.h>

namespace control_toolbox
{

/// offset + amplitude * sin(phase + 2 pi frequency t); frequency in Hz, phase in rad.
class Sinusoid
{
public:
  Sinusoid() = default;
  Sinusoid(double offset, double amplitude, double frequency, double phase)
    : offset_(offset)
    , amplitude_(amplitude)
    , frequency_(frequency)
    , phase_(phase)
  {
  }
  virtual ~Sinusoid() = default;

  /// Attributes offset, amplitude, frequency, phase. \return false: one is missing
  bool initXml(TiXmlElement* element)
  {
    struct Entry
    {
      const char* name;
      double* value;
    };
    const Entry entries[] = {
      { "offset", &offset_ }, { "amplitude", &amplitude_ }, { "frequency", &frequency_ }, { "phase", &phase_ }
    };
    for (const Entry& entry : entries)
    {
      const char* text = element->Attribute(entry.name);
      if (!text)
        return false;
      *entry.value = std::atof(text);
    }
    return true;
  }

  void debug() { ROS_DEBUG("offset=%.2f amplitude=%.2f phase=%.2f frequency=%.2f", offset_, amplitude_, phase_, frequency_); }

  /// \param[out] qd, qdd first and second derivative \return the value at \p time, s
  double update(double time, double& qd, double& qdd)
  {
    const double omega = 2.0 * M_PI * frequency_, angle = phase_ + omega * time;
    qd = amplitude_ * omega * std::cos(angle);
    qdd = -amplitude_ * omega * omega * std::sin(angle);
    return offset_ + amplitude_ * std::sin(angle);
  }

private:
  double offset_ = 0.0, amplitude_ = 0.0, frequency_ = 0.0, phase_ = 0.0;
};

}  // namespace control_toolbox
