#include <sdf/sdf.hh>

#include "numbers.hpp"

using namespace ignition::math;

namespace
{

const char* const document = R"(<?xml version='1.0'?>
<sdf version='1.9'>
  <model name='m'>
    <pose>1 2 3 0 0 0</pose>
    <link name='base'>
      <inertial><mass>2.5</mass></inertial>
      <sensor name='s' type='ray'>
        <update_rate>10</update_rate>
        <ray><scan><horizontal><samples>5</samples></horizontal></scan></ray>
      </sensor>
      <foo:bar xmlns:foo='x'>7</foo:bar>
    </link>
    <plugin name='p' filename='libp.so'>
      <a>1.5</a><i>42</i><exp>1e-3</exp><hex>0x10</hex><zero>010</zero><big>99999999999</big><plus>+5</plus><mixed>12abc</mixed>
      <word>abc</word><e/><e2></e2><nl>
      5
      </nl><ineg>-3</ineg><inf>inf</inf><nan>nan</nan><s> hello  world </s><b>yes</b><bt>true</bt><bT>True</bT><bf>false</bf><b1>1</b1>
      <b0>0</b0><c>1 2 3</c><pose frame='f'>1 2 3 0.1 0.2 0.3</pose><short>1 2</short><many>1 2 3 4</many><rpy>0.1 0.2 0.3</rpy>
      <t>1 500</t><col>0.1 0.2 0.3 1</col><ang>1.57</ang><ch>x</ch><name>child</name><ns:x>3</ns:x>
      <list><item id='1'>one</item><item id='2'>two</item><other/></list>
      <mix>text<inner>3</inner></mix>
    </plugin>
  </model>
</sdf>)";

/// What the library says about bad values is not what is tested.
class Sdf : public testing::Test
{
protected:
  void SetUp() override
  {
    sdf::Console::Instance()->SetQuiet(true);
    whole.reset(new sdf::SDF());
    sdf::init(whole);
    sdf::Errors errors;
    ASSERT_TRUE(sdf::readString(document, whole, errors));
    model = whole->Root()->GetElement("model");
    plugin = model->GetElement("plugin");
  }
  void TearDown() override { sdf::Console::Instance()->SetQuiet(false); }

  template <typename T>
  T get(const std::string& key) const
  {
    return plugin->Get<T>(key);
  }
  sdf::ElementPtr described(const std::string& name) const { return model->GetElement("link")->AddElement(name); }

  sdf::SDFPtr whole;
  sdf::ElementPtr model, plugin;
};

}  // namespace

TEST_F(Sdf, numbers_and_words)
{
  for (const char* key :
       { "a", "i", "exp", "hex", "zero", "big", "plus", "mixed", "word", "e",       "e2",  "nl",   "ineg", "inf",     "nan",
         "s", "b", "bt",  "bT",  "bf",   "b1",  "b0",   "c",     "ch",   "missing", "mix", "ns:x", "name", "filename" })
  {
    CHECK(get<double>(key));
    CHECK(get<int>(key));
    CHECK(get<unsigned int>(key));
    CHECK(get<std::string>(key));
    CHECK(get<bool>(key));
    CHECK(get<float>(key));
    CHECK(get<std::uint64_t>(key));
    CHECK(plugin->HasElement(key) + 2 * plugin->HasAttribute(key));
  }
  CHECK(get<char>("ch"));
  CHECK(get<char>("b"));
}

TEST_F(Sdf, things_of_several_numbers)
{
  for (const char* key : { "c", "pose", "short", "many", "rpy", "t", "a", "col", "missing", "e", "word" })
  {
    CHECK(get<Vector3d>(key));
    CHECK(get<Pose3d>(key));
    CHECK(get<Quaterniond>(key));
    CHECK(get<Vector2d>(key));
    CHECK(get<Color>(key));
    CHECK(get<Angle>(key));
    CHECK(shown(get<Vector2i>(key)));
  }
  CHECK(shown(get<sdf::Time>("t")));
}

TEST_F(Sdf, defaults)
{
  for (const char* key : { "missing", "a", "word", "e", "filename" })
  {
    CHECK(plugin->Get<double>(key, 3.5).first);
    CHECK(plugin->Get<double>(key, 3.5).second);
    CHECK(plugin->Get<std::string>(key, "otherwise").first);
    CHECK(plugin->Get<std::string>(key, "otherwise").second);
    double value = 9;
    CHECK(plugin->Get<double>(key, value, 2.0));
    CHECK(value);
    CHECK(plugin->Get<Vector3d>(key, Vector3d(1, 2, 3)).first);
  }
  CHECK(plugin->GetElement("missing") == nullptr);
  CHECK(plugin->GetElement("e")->GetValue() == nullptr);
  CHECK(plugin->GetElement("a")->Get<double>());
  CHECK(plugin->Get<std::string>());
  CHECK(plugin->Get<double>("", 4.5).second);
}

TEST_F(Sdf, family)
{
  std::string names;
  for (auto each = plugin->GetElement("list")->GetFirstElement(); each; each = each->GetNextElement())
    names += each->GetName() + " " + each->Get<std::string>() + ",";
  CHECK(names);
  names.clear();
  for (auto each = plugin->GetElement("list")->GetElement("item"); each; each = each->GetNextElement("item"))
    names += each->GetAttribute("id")->GetAsString() + " " + std::to_string(each->Get<int>("id")) + ",";
  CHECK(names);
  CHECK(plugin->GetName());
  CHECK(plugin->GetParent()->GetName());
  CHECK(plugin->GetParent()->Get<std::string>("name"));
  CHECK(plugin->GetAttributeCount());
  CHECK(plugin->GetAttribute(1)->GetKey());
  CHECK(plugin->GetAttribute(7) == nullptr);
  CHECK(plugin->GetAttribute("name")->GetTypeName());
  CHECK(plugin->GetAttribute("name")->GetSet());
  CHECK(plugin->GetAttribute("none") == nullptr);
  CHECK(plugin->GetElement("a")->GetValue()->GetTypeName());
  CHECK(plugin->GetElement("a")->GetValue()->GetKey());
  CHECK(plugin->FindElement("a") != nullptr);
  CHECK(plugin->GetElementTypeNames().size());
  CHECK(model->CountNamedElements("link").at("base"));
  CHECK(whole->Root()->GetName());
  CHECK(whole->OriginalVersion());
}

TEST_F(Sdf, changes)
{
  const auto a = plugin->GetElement("a"), e = plugin->GetElement("e");
  CHECK(a->Set(2.25));
  CHECK(a->Get<std::string>());
  CHECK(a->Set<std::string>("word"));
  CHECK(a->Get<std::string>());
  CHECK(a->Set(true));
  CHECK(a->Get<bool>());
  CHECK(plugin->GetElement("c")->Set(Vector3d(4, 5, 6.5)));
  CHECK(get<Vector3d>("c"));
  CHECK(e->Set(3));
  CHECK(e->Get<int>());
  CHECK(plugin->GetAttribute("name")->SetFromString("renamed"));
  CHECK(get<std::string>("name"));
  const auto clone = plugin->Clone();
  plugin->GetElement("i")->RemoveFromParent();
  CHECK(plugin->HasElement("i") + 2 * clone->HasElement("i"));
  CHECK(clone->GetParent() == nullptr);
  clone->ClearElements();
  CHECK(clone->GetFirstElement() == nullptr);
  const sdf::ElementPtr made(new sdf::Element);
  made->SetName("made");
  made->AddAttribute("id", "int", "4", true);
  made->AddValue("double", "1.5", true);
  CHECK(made->Get<double>());
  CHECK(made->Get<int>("id"));
  CHECK(made->ToString(""));
  CHECK(made->GetValue()->SetFromString("abc"));
  CHECK(made->Get<double>());
  plugin->InsertElement(made);
  CHECK(get<double>("made"));
  const sdf::ElementPtr copy(new sdf::Element);
  copy->Copy(made);
  CHECK(copy->ToString("  "));
}

TEST_F(Sdf, text)
{
  CHECK(plugin->ToString("  "));
  CHECK(model->ToString(""));
  CHECK(whole->ToString());
  sdf::SDF other;
  other.SetFromString("<sdf version='1.9'><model name='ball'><link name='l'/></model></sdf>");
  CHECK(other.ToString());
  other.Root()->GetElement("model")->GetAttribute("name")->SetFromString("other");
  CHECK(other.Root()->GetElement("model")->Get<std::string>("name"));
}

TEST_F(Sdf, what_the_format_describes)
{
  const auto link = model->GetElement("link");
  CHECK(model->HasElement("static"));
  CHECK(model->Get<bool>("static"));
  CHECK(model->Get<bool>("static", true).first);
  CHECK(model->Get<bool>("static", true).second);
  CHECK(model->GetElement("static")->GetName());
  CHECK(model->HasElement("static"));
  CHECK(link->Get<bool>("gravity"));
  CHECK(link->GetElement("inertial")->Get<double>("mass"));
  CHECK(link->GetElement("inertial")->GetElement("inertia")->Get<double>("ixx"));
  CHECK(link->GetElement("inertial")->Get<Pose3d>("pose"));
  CHECK(described("visual")->ToString(""));
  CHECK(described("collision")->ToString(""));
  const auto ode = described("collision")->GetElement("surface")->GetElement("friction")->GetElement("ode");
  CHECK(ode->Get<double>("mu"));
  CHECK(ode->Get<double>("slip1"));
  const auto sensor = described("sensor");
  CHECK(sensor->Get<bool>("always_on"));
  CHECK(sensor->GetElement("ray")->ToString(""));
  CHECK(sensor->GetElement("camera")->Get<double>("horizontal_fov"));
  CHECK(sensor->GetElement("camera")->GetElement("image")->Get<int>("width"));
  CHECK(sensor->Get<std::string>("topic"));
  const auto joint = model->AddElement("joint");
  CHECK(joint->GetElement("axis")->Get<Vector3d>("xyz"));
  CHECK(joint->GetElement("axis")->GetElement("dynamics")->Get<double>("damping"));
  CHECK(joint->Get<std::string>("parent"));
  const auto box = described("collision")->GetElement("geometry")->GetElement("box");
  CHECK(box->Get<Vector3d>("size"));
  CHECK(box->GetElement("size")->Set(Vector3d(3, 2, 1)));
  CHECK(box->ToString(""));
  CHECK(model->AddElement("nothing_of_this_name") == nullptr);
  const auto world = whole->Root()->AddElement("world");
  CHECK(world->Get<Vector3d>("gravity"));
  CHECK(world->GetElement("physics")->Get<double>("max_step_size"));
  CHECK(world->GetElement("physics")->GetElement("ode")->GetElement("solver")->Get<int>("iters"));
  CHECK(world->GetElement("spherical_coordinates")->Get<double>("latitude_deg"));
}

TEST_F(Sdf, what_is_no_document)
{
  for (const char* text : { "<sdf version='1.9'><model", "", "<sdf version='1.9'><model name='m'><link/></model></sdf>",
                            "<sdf version='1.9'><model name='m'><link name='l'><gravity>perhaps</gravity></link></model></sdf>",
                            "<sdf version='1.9'><model name='m'><link name='l'><bogus>3</bogus></link></model></sdf>" })
  {
    const sdf::SDFPtr other(new sdf::SDF());
    sdf::init(other);
    sdf::Errors errors;
    CHECK(sdf::readString(text, other, errors));
  }
  const sdf::SDFPtr other(new sdf::SDF());
  sdf::Errors errors;
  CHECK(sdf::readFile("/there/is/no.sdf", other, errors));
  CHECK(sdf::trim("  a b\n"));
  CHECK(sdf::split("a::b::c", "::").size());
  CHECK(sdf::lowercase("AbC"));
  CHECK(sdf::SplitName("a::b::c").first + "|" + sdf::SplitName("a::b::c").second);
  CHECK(sdf::JoinName("a::b", "c"));
}
