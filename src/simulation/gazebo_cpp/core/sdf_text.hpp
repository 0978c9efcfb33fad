// SDF elements from text.
#pragma once
#include <string>

#include <sdf/sdf.hh>

namespace gazebo
{
/// <model> of that name; the text is an <sdf> with a model. An empty <model> where the text cannot be read.
sdf::ElementPtr model_element(const std::string& text, const std::string& name);
/// <world>, in the same way.
sdf::ElementPtr world_element(const std::string& text, const std::string& name);
/// The ``index``-th <plugin> of ``owner``; where it has none such, that of ``text`` alone.
sdf::ElementPtr plugin_element(const sdf::ElementPtr& owner, int index, const std::string& text);
/// Its first child with this tag; null where there is none.
inline sdf::ElementPtr inside(const sdf::ElementPtr& sdf, const char* tag)
{
  return sdf && sdf->HasElement(tag) ? sdf->GetElement(tag) : sdf::ElementPtr();
}

}  // namespace gazebo
