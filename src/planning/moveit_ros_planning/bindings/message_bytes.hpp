// Messages go between C++ and Python as the bytes that ROS sends.
#pragma once

#include <ros/serialization.h>

#include <string>

template <typename Message>
Message read(const std::string& bytes)
{
  Message message;
  ros::serialization::IStream stream(reinterpret_cast<std::uint8_t*>(const_cast<char*>(bytes.data())), bytes.size());
  ros::serialization::deserialize(stream, message);
  return message;
}

template <typename Message>
std::string written(const Message& message)
{
  std::string bytes(ros::serialization::serializationLength(message), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(&bytes[0]), bytes.size());
  ros::serialization::serialize(stream, message);
  return bytes;
}
