// The base of plugins that use roscpp. Declared for building only: no plugin in C++ is loaded here.
#pragma once

#include <nodelet/nodelet.h>
#include <qt_gui_cpp/plugin.h>

namespace rqt_gui_cpp
{
class Plugin : public qt_gui_cpp::Plugin, public nodelet::Nodelet
{
public:
  void onInit() override {}
};
}  // namespace rqt_gui_cpp
