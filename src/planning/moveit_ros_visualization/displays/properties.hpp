// Properties of displays, and what is done when they change.
#pragma once

#include <QObject>
#include <rviz/properties/property.h>

namespace moveit_rviz_plugin {

// Connected after the property was made, so that its first value calls nobody.
template <typename Property, typename Changed>
Property* when(Property* property, QObject* receiver, Changed changed) {
  QObject::connect(property, &rviz::Property::changed, receiver, changed);
  return property;
}

}  // namespace moveit_rviz_plugin
