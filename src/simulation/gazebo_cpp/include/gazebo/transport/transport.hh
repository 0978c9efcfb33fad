#pragma once
#include <gazebo/gazebo_config.h>
#include <gazebo/msgs/msgs.hh>
#include <gazebo/transport/Node.hh>
#include <gazebo/transport/Publisher.hh>
#include <gazebo/transport/Subscriber.hh>
#include <gazebo/transport/TransportIface.hh>
#include <gazebo/transport/TransportTypes.hh>
