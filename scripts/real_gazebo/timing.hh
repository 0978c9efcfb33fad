// What steps cost, making a model and ending: for scripts/bench gazebo.
#pragma once

#include <sys/resource.h>
#include <time.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include <gazebo/common/common.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

class Timing
{
public:
  void Begin(gazebo::physics::WorldPtr world, std::FILE* file, int steps)
  {
    world_ = world;
    file_ = file;
    timing_ = steps;
    if (steps)
      end_ = gazebo::event::Events::ConnectWorldUpdateEnd([this] { Time(); });
  }

  bool Wanted() const { return timing_ > 0; }

  static double Clock(clockid_t which)
  {
    timespec now;
    clock_gettime(which, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
  }

  // Called by the thread that steps the world, after each step.
  void Time()
  {
    const long n = ++timed_;
    if (n == 1)
      std::fprintf(file_, "first,%.6f\n", Clock(CLOCK_REALTIME));
    if (n != kWarm && n != kWarm + timing_)
      return;
    const double sign = n == kWarm ? -1 : 1;
    wall_ += sign * Clock(CLOCK_MONOTONIC), thread_time_ += sign * Clock(CLOCK_THREAD_CPUTIME_ID),
        process_ += sign * Clock(CLOCK_PROCESS_CPUTIME_ID);
    measured_ = n != kWarm;
  }

  void Run()
  {
    world_->SetPaused(false);
    while (!measured_)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    std::fprintf(file_, "steps,%d,%.9g,%.9g,%.9g,%.9g\n", timing_, world_->Physics()->GetMaxStepSize(), wall_, thread_time_,
                 process_);
    for (int i = 0; i < 5; ++i)
    {
      const auto before = world_->ModelCount();
      const double start = Clock(CLOCK_MONOTONIC);
      world_->InsertModelString(
          "<?xml version='1.0'?><sdf version='1.6'><model name='new" + std::to_string(i) + "'><pose>" + std::to_string(50 + i) +
          " 0 1 0 0 0</pose><link name='l'><collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision></link>"
          "</model></sdf>");
      while (world_->ModelCount() == before)
        std::this_thread::sleep_for(std::chrono::microseconds(200));
      std::fprintf(file_, "spawn,%.6f\n", Clock(CLOCK_MONOTONIC) - start);
    }
    rusage used;  // not of /proc, which a chroot may lack
    getrusage(RUSAGE_SELF, &used);
    std::fprintf(file_, "maxrss,%ld\n", used.ru_maxrss);
    std::fprintf(file_, "end,0\n");
    std::fflush(file_);
  }

private:
  static constexpr long kWarm = 500;  // steps that are not counted
  gazebo::physics::WorldPtr world_;
  std::FILE* file_ = nullptr;
  int timing_ = 0;
  long timed_ = 0;
  double wall_ = 0, thread_time_ = 0, process_ = 0;
  std::atomic<bool> measured_{ false };
  gazebo::event::ConnectionPtr end_;
};
