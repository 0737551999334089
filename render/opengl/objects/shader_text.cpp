// GLSL has no #include. Directives #line tell the compiler which file and line each line comes from.
#include "render/opengl/objects/shader_text.h"

#include <regex>
#include <stdexcept>

#include <fmt/format.h>

namespace render {

namespace {

constexpr std::string_view kInclude = "#include \"";

void append(std::string_view name, ShaderSource& source) {
    std::string_view rest = shaderText(name);
    if (rest.empty()) throw std::logic_error(fmt::format("render: there is no shader {}", name));
    const std::size_t index = source.files.size();
    source.files.emplace_back(name);
    source.text += fmt::format("#line 1 {}\n", index);
    for (int line = 1; !rest.empty(); ++line) {
        const std::size_t end = std::min(rest.find('\n'), rest.size() - 1);
        const std::string_view text = rest.substr(0, end + 1);
        rest.remove_prefix(end + 1);
        if (text.substr(0, kInclude.size()) != kInclude) {
            source.text += text;
            continue;
        }
        const std::string_view included = text.substr(kInclude.size());
        append(included.substr(0, included.find('"')), source);
        source.text += fmt::format("#line {} {}\n", line + 1, index);
    }
}

}  // namespace

ShaderSource shaderSource(std::string_view name, const std::vector<std::string>& defines) {
    ShaderSource source;
    source.text = "#version 330 core\n";
    for (const std::string& define : defines) source.text += "#define " + define + "\n";
    append(name, source);
    return source;
}

std::string withFileNames(std::string_view log, const ShaderSource& source) {
    static const std::regex place(R"(\b(\d+)(?::(\d+)|\((\d+)\)))");
    std::string result;
    auto rest = log.begin();
    for (std::cregex_iterator match(log.data(), log.data() + log.size(), place), end; match != end; ++match) {
        const std::size_t file = std::stoul((*match)[1].str());
        result.append(rest, log.begin() + match->position());
        const std::string line = (*match)[2].matched ? (*match)[2].str() : (*match)[3].str();
        result += file < source.files.size() ? source.files[file] + ":" + line : (*match)[0].str();
        rest = log.begin() + match->position() + match->length();
    }
    result.append(rest, log.end());
    return result;
}

}  // namespace render
