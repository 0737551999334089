// Videos in a temporary folder, for the tests of videos.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "render/output/video.h"

namespace video_files {

namespace fs = std::filesystem;

// A temporary folder that is removed with the object.
struct Folder {
    Folder() : path(fs::temp_directory_path() / ("globular-video-test-" + std::to_string(::getpid()))) {
        fs::create_directories(path);
    }
    ~Folder() { fs::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::string file(const std::string& name) const { return (path / name).string(); }
    long entryCount() const { return std::distance(fs::directory_iterator(path), fs::directory_iterator()); }
    fs::path path;
};

inline render::Image frame(render::PictureSize size, int index) {
    render::Image image{size.width, size.height, {}};
    image.rgb.resize(image.byteCount());
    for (std::size_t k = 0; k < image.rgb.size(); ++k)
        image.rgb[k] = static_cast<std::uint8_t>((k / 3 * 5 + static_cast<std::size_t>(index) * 40 + k % 3 * 80) % 256);
    return image;
}

inline void writeVideo(const render::VideoOptions& options, int frames) {
    render::VideoWriter writer(options);
    for (int k = 0; k < frames; ++k) writer.add(frame(options.size, k));
    writer.finish();
}

inline std::string bytesOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace video_files
