// Texts of standard input, each ended by a zero byte, as TinyXML reads them: one JSON line for each, null where it refuses.
#include <cstdio>
#include <iostream>
#include <iterator>
#include <string>
#include <tinyxml.h>

namespace
{
std::string quoted(const std::string& text)
{
  std::string out = "\"";
  for (unsigned char c : text)
  {
    char code[8];
    std::snprintf(code, sizeof code, "\\u%04x", c);  // bytes as code points: the test decodes them
    out += code;
  }
  return out + "\"";
}

std::string shown(const TiXmlElement& element)
{
  std::string out = "[" + quoted(element.ValueStr()) + "," + std::to_string(element.Row()) + ",{";
  for (const TiXmlAttribute* a = element.FirstAttribute(); a; a = a->Next())
    out += (a == element.FirstAttribute() ? "" : ",") + quoted(a->Name()) + ":" + quoted(a->ValueStr());
  out += "}," + (element.GetText() ? quoted(element.GetText()) : std::string("null"));
  for (const TiXmlElement* c = element.FirstChildElement(); c; c = c->NextSiblingElement())
    out += "," + shown(*c);
  return out + "]";
}
}  // namespace

int main()
{
  const std::string input((std::istreambuf_iterator<char>(std::cin)), {});
  for (std::size_t at = 0; at < input.size();)
  {
    const std::string text = input.substr(at, input.find('\0', at) - at);
    at += text.size() + 1;
    TiXmlDocument document;
    document.Parse(text.c_str());
    std::string out = "[";
    for (const TiXmlElement* e = document.FirstChildElement(); e; e = e->NextSiblingElement())
      out += (out.size() > 1 ? "," : "") + shown(*e);
    std::cout << (document.Error() && document.ErrorId() != TiXmlBase::TIXML_ERROR_DOCUMENT_EMPTY ? "null" : out + "]") << "\n";
  }
}
