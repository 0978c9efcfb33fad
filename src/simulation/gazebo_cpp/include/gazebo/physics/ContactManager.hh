#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gazebo/physics/Contact.hh>
#include <gazebo/common/common.hh>
#include <gazebo/transport/TransportTypes.hh>

namespace gazebo
{
namespace physics
{

/// Contacts of the last step. Their forces are measured from the step after the first question on.
class GAZEBO_VISIBLE ContactManager
{
public:
  ContactManager();
  ~ContactManager();
  unsigned int GetContactCount() const { return static_cast<unsigned int>(GetContacts().size()); }
  Contact* GetContact(unsigned int index) const;
  const std::vector<Contact*>& GetContacts() const;
  void SetNeverDropContacts(bool) {}
  bool NeverDropContacts() const { return true; }
  std::string CreateFilter(const std::string& name, const std::vector<std::string>& collisions);
  std::string CreateFilter(const std::string& name, const std::string& collision);
  std::string CreateFilter(const std::string& name, const std::map<std::string, CollisionPtr>& collisions);
  void RemoveFilter(const std::string& name);
  unsigned int GetFilterCount();
  bool HasFilter(const std::string& name);
  void PublishContacts();

private:
  friend class Mirror;
  struct Private;
  std::unique_ptr<Private> data_;
};

}  // namespace physics
}  // namespace gazebo
