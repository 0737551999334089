// The tags of an XML file, one after the other, as far as VTK files need them: no entities, no CDATA.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scenes {

/// A tag: <name attribute="value">, </name> or <name/>.
struct XmlTag {
    std::string_view name;
    bool isEnd = false;      ///< </name>
    bool isEmpty = false;    ///< <name/>
    int line = 0;            ///< where it begins, from 1
    std::size_t textAt = 0;  ///< index of the first byte after it
    std::vector<std::pair<std::string_view, std::string_view>> attributes;

    /// The value of an attribute; `fallback` if there is none of that name.
    std::string_view value(std::string_view attribute, std::string_view fallback = "") const;
};

class XmlTags {
 public:
    /// @param bytes, fileName  must outlive the object and the tags
    XmlTags(std::string_view bytes, const std::string& fileName) : bytes_(bytes), fileName_(&fileName) {}

    /// Finds the next tag. Comments and declarations are skipped. Returns false at the end of the file.
    /// @throws InputError for a tag that does not end or is not one
    bool next(XmlTag& tag);

    /// Throws an InputError that names the file and a line.
    [[noreturn]] void fail(int line, const std::string& message) const;

 private:
    std::string_view takeName();
    void takeAttribute(XmlTag& tag);
    void skipTo(std::size_t index);
    void skipBlanks();

    std::string_view bytes_;
    const std::string* fileName_;
    std::size_t at_ = 0;
    int line_ = 1;
};

}  // namespace scenes
