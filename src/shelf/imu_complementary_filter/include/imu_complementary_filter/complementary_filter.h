// The complementary filter of this package's node, for programs in C++ that hold one themselves.
#pragma once

namespace imu_tools {
/// Orientation of a sensor in a world whose z is up (R. Valenti, I. Dryanovski, J. Xiao, 2015); with a magnetic field its x is magnetic north.
class ComplementaryFilter {
 public:
  ComplementaryFilter();
  virtual ~ComplementaryFilter();

  /// Share of the error against gravity, or of the yaw against north, that one reading takes away: 0 to 1; false, and as before, for others.
  bool setGainAcc(double gain);
  bool setGainMag(double gain);
  double getGainAcc() const;
  double getGainMag() const;

  /// Share of the turn rates at rest that goes into their bias: 0 to 1, else false.
  bool setBiasAlpha(double bias_alpha);
  double getBiasAlpha() const;
  void setDoBiasEstimation(bool do_bias_estimation);
  bool getDoBiasEstimation() const;
  /// Whether the last reading was of a sensor at rest; known while a bias is looked for.
  bool getSteadyState() const;
  double getAngularVelocityBiasX() const;
  double getAngularVelocityBiasY() const;
  double getAngularVelocityBiasZ() const;

  /// Whether readings that are not of gravity's size count less: at 10 % off in full, at 20 % not at all.
  void setDoAdaptiveGain(bool do_adaptive_gain);
  bool getDoAdaptiveGain() const;

  /// w, x, y, z of the sensor in the world.
  void setOrientation(double q0, double q1, double q2, double q3);
  void getOrientation(double& q0, double& q1, double& q2, double& q3) const;

  /// One reading: acceleration (m/s^2, with gravity), turn rates (rad/s), s since the last one. The first sets the orientation.
  void update(double ax, double ay, double az, double wx, double wy, double wz, double dt);
  /// The same with a magnetic field, in any unit.
  void update(double ax, double ay, double az, double wx, double wy, double wz, double mx, double my, double mz, double dt);

  void reset();

 private:
  void take(const double acceleration[3], const double rate[3], const double* field, double dt);
  void lookForBias(const double acceleration[3], const double rate[3]);
  double trust(const double acceleration[3]) const;

  double gain_acc_, gain_mag_, bias_alpha_;
  bool do_bias_estimation_, do_adaptive_gain_;
  bool initialized_, steady_state_;
  double orientation_[4];  // w, x, y, z of the sensor in the world
  double bias_[3], before_[3];
};
}  // namespace imu_tools
