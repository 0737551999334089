#include "scenes/particles/xml_tags.h"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/text/input_error.h"

namespace scenes {
namespace {

constexpr std::string_view kXmlBlanks = " \t\r\n";

}  // namespace

std::string_view XmlTag::value(std::string_view attribute, std::string_view fallback) const {
    for (const auto& [key, text] : attributes)
        if (key == attribute) return text;
    return fallback;
}

void XmlTags::fail(int line, const std::string& message) const {
    throw InputError({{*fileName_, line, 0, message}});
}

/// Goes on to a byte, counting the lines up to it.
void XmlTags::skipTo(std::size_t index) {
    const std::size_t end = std::min(index, bytes_.size());
    line_ += static_cast<int>(std::ranges::count(bytes_.substr(at_, end - at_), '\n'));
    at_ = end;
}

void XmlTags::skipBlanks() {
    skipTo(bytes_.find_first_not_of(kXmlBlanks, at_));
}

std::string_view XmlTags::takeName() {
    const std::size_t end = std::min(bytes_.find_first_of(" \t\r\n=/><\"'", at_), bytes_.size());
    const std::string_view name = bytes_.substr(at_, end - at_);
    if (name.empty()) fail(line_, "this is not XML: a name is missing");
    at_ = end;
    return name;
}

void XmlTags::takeAttribute(XmlTag& tag) {
    const std::string_view name = takeName();
    skipBlanks();
    if (at_ >= bytes_.size() || bytes_[at_] != '=')
        fail(line_, fmt::format("\"=\" is missing after {}", name.substr(0, 40)));
    skipTo(at_ + 1);
    skipBlanks();
    const char quote = at_ < bytes_.size() ? bytes_[at_] : ' ';
    const std::size_t end = quote == '"' || quote == '\'' ? bytes_.find(quote, at_ + 1) : std::string_view::npos;
    if (end == std::string_view::npos)
        fail(line_, fmt::format("the value of {} is not in quotation marks", name.substr(0, 40)));
    tag.attributes.emplace_back(name, bytes_.substr(at_ + 1, end - at_ - 1));
    skipTo(end + 1);
}

bool XmlTags::next(XmlTag& tag) {
    while (true) {
        skipTo(bytes_.find('<', at_));
        if (at_ >= bytes_.size()) return false;
        const bool isComment = bytes_.substr(at_).starts_with("<!--");
        if (!isComment && bytes_.substr(at_, 2) != "<?" && bytes_.substr(at_, 2) != "<!") break;
        const std::string_view ending = isComment ? "-->" : ">";
        const std::size_t end = bytes_.find(ending, at_);
        if (end == std::string_view::npos) fail(line_, "a comment or declaration does not end");
        skipTo(end + ending.size());
    }
    tag = {};
    tag.line = line_;
    skipTo(at_ + 1);
    tag.isEnd = at_ < bytes_.size() && bytes_[at_] == '/';
    if (tag.isEnd) skipTo(at_ + 1);
    tag.name = takeName();
    for (skipBlanks(); at_ < bytes_.size() && bytes_[at_] != '>' && bytes_[at_] != '/'; skipBlanks())
        takeAttribute(tag);
    tag.isEmpty = at_ < bytes_.size() && bytes_[at_] == '/';
    if (tag.isEmpty) skipTo(at_ + 1);
    if (at_ >= bytes_.size() || bytes_[at_] != '>')
        fail(tag.line, fmt::format("<{} does not end", tag.name.substr(0, 40)));
    skipTo(at_ + 1);
    tag.textAt = at_;
    return true;
}

}  // namespace scenes
