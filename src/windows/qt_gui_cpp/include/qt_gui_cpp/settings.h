// Settings as plugins see them. Declared for building only: no plugin in C++ is loaded here.
#pragma once

#include <QObject>
#include <QString>
#include <QStringList>
#include <QVariant>

namespace qt_gui_cpp
{
class Settings
{
public:
  QStringList allKeys() const { return {}; }
  QStringList childGroups() const { return {}; }
  QStringList childKeys() const { return {}; }
  bool contains(const QString&) const { return false; }
  Settings getSettings(const QString&) const { return {}; }
  void remove(const QString&) {}
  void setValue(const QString&, const QVariant&) {}
  QVariant value(const QString&, const QVariant& otherwise = QVariant()) const { return otherwise; }
};
}  // namespace qt_gui_cpp
