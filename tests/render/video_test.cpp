// Videos: what ffprobe reads back, and identical bytes on one core and on several.
#include <sched.h>

#include "tests/catch.h"

#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "render/output/child_process.h"
#include "render/output/png.h"
#include "render/output/video.h"
#include "render/output/video_reader.h"
#include "render/picture/system_error.h"
#include "tests/render/video_files.h"

using namespace video_files;

namespace {

std::string probe(const std::string& path) {
    render::ChildProcess child({"ffprobe", "-v", "error", "-count_frames", "-select_streams", "v:0", "-show_entries",
                                "stream=codec_name,width,height,pix_fmt,color_range,color_space,color_transfer,color_"
                                "primaries,r_frame_rate,nb_read_frames",
                                "-of", "default=noprint_wrappers=1", path});
    CHECK(child.wait().empty());
    return child.output();
}

}  // namespace

TEST_CASE("A video has its frames, rate, size and color tags") {
    const Folder folder;
    const std::string path = folder.file("a.mp4");
    writeVideo({path, {64, 48}, {25}}, 7);
    const std::string found = probe(path);
    INFO(found);
    for (const char* expected :
         {"codec_name=h264", "width=64", "height=48", "pix_fmt=yuv420p", "color_range=tv", "color_space=bt709",
          "color_transfer=bt709", "color_primaries=bt709", "r_frame_rate=25/1", "nb_read_frames=7"}) {
        CHECK_THAT(found, Catch::Contains(expected));
    }
    CHECK(folder.entryCount() == 1);
}

TEST_CASE("A frame rate may be a fraction") {
    const Folder folder;
    writeVideo({folder.file("a.mp4"), {64, 48}, {30000, 1001}}, 5);
    const std::string found = probe(folder.file("a.mp4"));
    CHECK_THAT(found, Catch::Contains("r_frame_rate=30000/1001"));
    CHECK_THAT(found, Catch::Contains("nb_read_frames=5"));
}

TEST_CASE("The extension names the kind of a video") {
    CHECK(render::videoKindOf("a.mp4") == render::VideoKind::mp4);
    CHECK(render::videoKindOf("out.gif/a.MKV") == render::VideoKind::mkv);
    CHECK(render::videoKindOf("a.png.webp") == render::VideoKind::webp);
    for (const char* other : {"", "-", "mp4", ".mp4", "a.avi", "a.mp4.txt", "a.gif/b", "a."})
        CHECK_FALSE(render::videoKindOf(other));
    CHECK_THROWS_AS(render::VideoWriter({"a.avi", {16, 16}}), std::logic_error);
}

TEST_CASE("Every kind of video is what its name says, of the frames' size and rate, with the same bytes again") {
    struct Expected {
        const char* name;
        const char* head;  // how the file begins, in bytes that only this kind has
        const char* codec;
        int width;  // of frames 33 pixels wide; kinds without halved colors need no padding
    };
    const auto [name, head, codec, width] =
        GENERATE(Expected{"a.mkv", "\x1A\x45\xDF\xA3", "h264", 34}, Expected{"a.webm", "\x1A\x45\xDF\xA3", "vp9", 34},
                 Expected{"a.gif", "GIF89a", "gif", 33}, Expected{"a.png", "\x89PNG", "apng", 33});
    INFO(name);
    const Folder folder;
    writeVideo({folder.file(name), {33, 18}, {25}}, 5);
    const std::string bytes = bytesOf(folder.file(name));
    CHECK(bytes.starts_with(head));
    const std::string found = probe(folder.file(name));
    INFO(found);
    CHECK_THAT(found, Catch::Contains("codec_name=" + std::string(codec)) &&
                          Catch::Contains("width=" + std::to_string(width)) && Catch::Contains("height=18") &&
                          Catch::Contains("nb_read_frames=5"));
    writeVideo({folder.file(name), {33, 18}, {25}}, 5);
    CHECK(bytesOf(folder.file(name)) == bytes);
}

TEST_CASE("Animated pictures repeat without end") {
    const Folder folder;
    for (const char* name : {"a.gif", "a.webp", "a.png"}) writeVideo({folder.file(name), {33, 17}, {25}}, 4);
    using namespace std::string_literals;
    // A count of 0 stands for no end: in GIF after the block's size and a 1, in WebP after ANIM, the size of the chunk
    // and a color of four bytes, in PNG after acTL and the number of frames.
    CHECK_THAT(bytesOf(folder.file("a.gif")), Catch::Contains("NETSCAPE2.0\x03\x01\0\0"s));
    CHECK_THAT(bytesOf(folder.file("a.png")), Catch::Contains("acTL\0\0\0\x04\0\0\0\0"s));
    const std::string webp = bytesOf(folder.file("a.webp"));
    const std::size_t loop = webp.find("ANIM\x06\0\0\0"s);
    REQUIRE(loop != std::string::npos);
    CHECK(webp.substr(loop + 12, 2) == "\0\0"s);
    std::size_t frames = 0;
    for (std::size_t at = webp.find("ANMF"); at != std::string::npos; at = webp.find("ANMF", at + 1)) ++frames;
    CHECK(frames == 4);
}

TEST_CASE("A PNG of one frame is an ordinary picture with the pixels of the frame") {
    const Folder folder;
    writeVideo({folder.file("a.png"), {33, 17}, {25}}, 1);
    const std::string bytes = bytesOf(folder.file("a.png"));
    CHECK(bytes.find("acTL") == std::string::npos);
    const std::vector<std::uint8_t> file(bytes.begin(), bytes.end());
    CHECK(render::decodePng(file, "a.png").rgb == frame({33, 17}, 0).rgb);
}

TEST_CASE("A GIF has at most 50 frames a second and lasts as long as its frames") {
    const Folder folder;
    writeVideo({folder.file("a.gif"), {32, 18}, {100}}, 40);
    const std::string found = probe(folder.file("a.gif"));
    INFO(found);
    CHECK_THAT(found, Catch::Contains("nb_read_frames=20"));
    CHECK_THAT(found, Catch::Contains("r_frame_rate=50/1"));
}

TEST_CASE("Odd sizes are padded to even") {
    const Folder folder;
    writeVideo({folder.file("odd.mp4"), {33, 17}, {30}}, 3);
    const std::string found = probe(folder.file("odd.mp4"));
    CHECK_THAT(found, Catch::Contains("width=34"));
    CHECK_THAT(found, Catch::Contains("height=18"));
    CHECK_THAT(found, Catch::Contains("nb_read_frames=3"));
}

TEST_CASE("The number of cores does not change a byte") {
    const Folder folder;
    cpu_set_t all;
    REQUIRE(sched_getaffinity(0, sizeof all, &all) == 0);
    std::size_t first = 0;
    while (!CPU_ISSET(first, &all)) ++first;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(first, &one);
    writeVideo({folder.file("all.mp4"), {640, 360}, {30}}, 24);
    REQUIRE(sched_setaffinity(0, sizeof one, &one) == 0);  // ffmpeg inherits it
    writeVideo({folder.file("one.mp4"), {640, 360}, {30}}, 24);
    REQUIRE(sched_setaffinity(0, sizeof all, &all) == 0);
    CHECK(bytesOf(folder.file("all.mp4")).size() > 1000);
    CHECK(bytesOf(folder.file("one.mp4")) == bytesOf(folder.file("all.mp4")));
}

TEST_CASE("Colors survive: a red video is red") {
    const Folder folder;
    render::Image red{64, 64, {}};
    for (int k = 0; k < 64 * 64; ++k) red.rgb.insert(red.rgb.end(), {220, 40, 30});
    {
        render::VideoWriter writer({folder.file("red.mp4"), {64, 64}, {30}});
        writer.add(red);
        writer.finish();
    }
    render::ChildProcess decoder({"ffmpeg", "-v", "error", "-nostdin", "-i", folder.file("red.mp4"), "-pix_fmt",
                                  "rgb24", "-f", "rawvideo", folder.file("red.rgb")});
    CHECK(decoder.wait().empty());
    const std::string bytes = bytesOf(folder.file("red.rgb"));
    REQUIRE(bytes.size() == 3 * 64 * 64);
    // 3 steps: the limited range rounds to 1.2 steps, and the encoder to one or two. BT.601 in place of BT.709 would
    // shift the color by 10 steps and more.
    CHECK(std::abs(int(static_cast<unsigned char>(bytes[6000])) - 220) <= 3);
    CHECK(std::abs(int(static_cast<unsigned char>(bytes[6001])) - 40) <= 3);
    CHECK(std::abs(int(static_cast<unsigned char>(bytes[6002])) - 30) <= 3);
}

TEST_CASE("A video is read frame by frame") {
    const Folder folder;
    writeVideo({folder.file("100%d.mp4"), {33, 17}}, 5);
    int waits = 0;
    const auto count = [&] { ++waits; };
    render::VideoReader reader(folder.file("100%d.mp4"));
    for (int k = 0; k < 5; ++k) {
        const std::optional<render::Image> image = reader.next(count);
        REQUIRE(image);
        CHECK(image->width == 34);  // padded to even numbers
        CHECK(image->height == 18);
        CHECK(image->rgb.size() == image->byteCount());
    }
    CHECK_FALSE(reader.next(count));
    CHECK(waits > 5);
    CHECK_THROWS_WITH(render::VideoReader(folder.file("none.mp4")).next(count),
                      Catch::Contains("ffmpeg cannot decode") && Catch::Contains("No such file"));
    CHECK_THROWS_AS(render::VideoReader(folder.file("100%d.mp4")).next([] { throw std::runtime_error("enough"); }),
                    std::runtime_error);
}
