// Videos: what ffprobe reads back, identical bytes on one core and on several, and every way in which ffmpeg fails.
#include <sched.h>
#include <sys/resource.h>

#include "tests/catch.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "render/output/child_process.h"
#include "render/output/png.h"
#include "render/output/video.h"
#include "render/output/video_reader.h"
#include "render/picture/system_error.h"

namespace fs = std::filesystem;

namespace {

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

render::Image frame(render::PictureSize size, int index) {
    render::Image image{size.width, size.height, {}};
    image.rgb.resize(image.byteCount());
    for (std::size_t k = 0; k < image.rgb.size(); ++k)
        image.rgb[k] = static_cast<std::uint8_t>((k / 3 * 5 + static_cast<std::size_t>(index) * 40 + k % 3 * 80) % 256);
    return image;
}

void writeVideo(const render::VideoOptions& options, int frames) {
    render::VideoWriter writer(options);
    for (int k = 0; k < frames; ++k) writer.add(frame(options.size, k));
    writer.finish();
}

std::string bytesOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string probe(const std::string& path) {
    render::ChildProcess child({"ffprobe", "-v", "error", "-count_frames", "-select_streams", "v:0", "-show_entries",
                                "stream=codec_name,width,height,pix_fmt,color_range,color_space,color_transfer,color_"
                                "primaries,r_frame_rate,nb_read_frames",
                                "-of", "default=noprint_wrappers=1", path});
    CHECK(child.wait().empty());
    return child.output();
}

// A shell script in place of ffmpeg that answers the probe for libx264 and otherwise runs `action`, in which $out is
// the path of the temporary file.
std::string fakeFfmpeg(const Folder& folder, const std::string& action) {
    const std::string path = folder.file("fake-ffmpeg");
    std::ofstream(path) << "#!/bin/sh\ncase \"$*\" in *encoder=libx264*) echo 'Encoder libx264'; exit 0;; esac\n"
                        << "for last; do :; done; out=${last#file:}\n"
                        << action << "\n";
    fs::permissions(path, fs::perms::owner_all);
    return path;
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

TEST_CASE("A missing ffmpeg is one clear SystemError") {
    const Folder folder;
    render::VideoOptions options{folder.file("a.mp4"), {16, 16}};
    options.ffmpeg = "/nowhere/ffmpeg";
    CHECK_THROWS_AS(render::VideoWriter(options), render::SystemError);
    CHECK_THROWS_WITH(render::VideoWriter(options), Catch::Contains("cannot start /nowhere/ffmpeg: No such file") &&
                                                        Catch::Contains("install ffmpeg"));
    CHECK(folder.entryCount() == 0);
}

TEST_CASE("Too few files that may be open are no missing ffmpeg") {
    const Folder folder;
    struct rlimit before = {};
    REQUIRE(::getrlimit(RLIMIT_NOFILE, &before) == 0);
    const struct rlimit none = {0, before.rlim_max};
    std::exception_ptr thrown;
    REQUIRE(::setrlimit(RLIMIT_NOFILE, &none) == 0);
    try {
        render::requireEncoder({folder.file("a.mp4"), {16, 16}});
    } catch (...) {
        thrown = std::current_exception();  // looked at below, because UBSan opens files to look at an object
    }
    REQUIRE(::setrlimit(RLIMIT_NOFILE, &before) == 0);
    REQUIRE(thrown != nullptr);
    CHECK_THROWS_WITH(std::rethrow_exception(thrown),
                      Catch::Contains("Too many open files") && !Catch::Contains("install"));
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

TEST_CASE("An ffmpeg without libx264 is named as such") {
    const Folder folder;
    render::VideoOptions options{folder.file("a.mp4"), {16, 16}};
    options.ffmpeg = "true";
    CHECK_THROWS_WITH(render::VideoWriter(options), Catch::Contains("no libx264 encoder, which a .mp4 file needs"));
    options.path = folder.file("a.webm");
    CHECK_THROWS_WITH(render::VideoWriter(options), Catch::Contains("no libvpx-vp9 encoder, which a .webm file needs"));
}

TEST_CASE("An ffmpeg that dies is one clear SystemError with its messages, and no SIGPIPE") {
    const Folder folder;
    const render::PictureSize size{640, 360};  // a frame exceeds the buffer of a socket
    render::VideoOptions options{folder.file("a.mp4"), size};
    options.ffmpeg = fakeFfmpeg(folder, "echo 'the disk is on fire' >&2; exit 3");
    const auto write = [&] { writeVideo(options, 5); };
    CHECK_THROWS_AS(write(), render::SystemError);
    CHECK_THROWS_WITH(write(), Catch::Contains("a.mp4") && Catch::Contains("exit status 3") &&
                                   Catch::Contains("the disk is on fire"));
    options.ffmpeg = fakeFfmpeg(folder, "kill -9 $$");
    CHECK_THROWS_WITH(write(), Catch::Contains("signal 9"));
    CHECK_FALSE(fs::exists(folder.file("a.mp4")));
}

TEST_CASE("An ffmpeg that hangs is killed") {
    const Folder folder;
    render::VideoOptions options{folder.file("a.mp4"), {640, 360}};  // a frame exceeds the buffer of a socket
    options.progressTimeout = std::chrono::milliseconds(200);
    options.ffmpeg = fakeFfmpeg(folder, "sleep 1000");  // reads no input
    CHECK_THROWS_WITH(writeVideo(options, 5), Catch::Contains("a.mp4") && Catch::Contains("no progress for 0.2 s"));
    options.ffmpeg = fakeFfmpeg(folder, "cat >/dev/null; sleep 1000");  // reads all input and does not end
    CHECK_THROWS_WITH(writeVideo(options, 5), Catch::Contains("no progress for 0.2 s"));
    CHECK_FALSE(fs::exists(folder.file("a.mp4")));
}

TEST_CASE("An ffmpeg that works longer than the timeout is waited for") {
    const Folder folder;
    render::VideoOptions options{folder.file("a.mp4"), {640, 360}};
    options.progressTimeout = std::chrono::milliseconds(300);
    // After its input has ended it works for 1 s: its file changes, as when +faststart moves the index to the front.
    options.ffmpeg =
        fakeFfmpeg(folder, "cat >/dev/null; for k in 1 2 3 4 5 6 7 8 9 10; do sleep 0.1; echo >>$out; done");
    writeVideo(options, 3);
    CHECK(bytesOf(options.path).size() == 10);
    // One process that only computes for more than three times the timeout.
    options.ffmpeg = fakeFfmpeg(folder, "exec perl -e 'while (<STDIN>) {} 1 while (times)[0] < 1'");
    writeVideo(options, 3);
    // A frame that takes as long: the input is not read meanwhile.
    options.ffmpeg =
        fakeFfmpeg(folder, "for k in 1 2 3 4 5 6 7 8 9 10; do sleep 0.1; echo >>$out; done; cat >/dev/null");
    writeVideo(options, 3);
}

TEST_CASE("Time in which this program and ffmpeg are both stopped is not held against ffmpeg") {
    const Folder folder;
    render::VideoOptions options{folder.file("a.mp4"), {640, 360}};
    options.progressTimeout = std::chrono::milliseconds(1500);
    // The script stops itself. Its helper then stops the program that waits for it for twice the timeout.
    options.ffmpeg = fakeFfmpeg(
        folder,
        "cat >/dev/null; (sleep 0.1; kill -STOP $PPID; sleep 3; kill -CONT $PPID; sleep 0.1; kill -CONT $$) &\n"
        "kill -STOP $$; echo >>$out");
    // A process of its own is stopped, so that no shell takes the suite for stopped.
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        try {
            writeVideo(options, 1);
        } catch (const std::exception&) {
            ::_exit(1);
        }
        ::_exit(0);
    }
    int status = -1;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(status == 0);
}

TEST_CASE("The encoder is known by the first line of ffmpeg's answer, even if it cannot write the others") {
    const Folder folder;
    const std::string path = folder.file("limited-ffmpeg");
    std::ofstream(path) << "#!/bin/sh\necho 'Encoder libx264 [H.264]:'; kill -XFSZ $$\n";
    fs::permissions(path, fs::perms::owner_all);
    render::VideoOptions options{folder.file("a.mp4"), {16, 16}};
    options.ffmpeg = path;
    CHECK_NOTHROW(render::requireEncoder(options));
    std::ofstream(path) << "#!/bin/sh\necho 'no such codec'; echo 'Encoder libx264'; exit 2\n";
    CHECK_THROWS_WITH(render::requireEncoder(options),
                      Catch::Contains("exit status 2: no such codec") && !Catch::Contains("\n"));
}

TEST_CASE("An ffmpeg that is killed at a limit on the size of files is one line") {
    const Folder folder;
    render::VideoOptions options{folder.file("a.mp4"), {640, 360}};
    options.ffmpeg = fakeFfmpeg(folder, "echo one >&2; echo two >&2; kill -XFSZ $$");
    const auto previous = std::signal(SIGXFSZ, SIG_IGN);  // as the program does; the script must not inherit it
    CHECK_THROWS_WITH(writeVideo(options, 5),
                      Catch::Contains("signal 25") && Catch::Contains("one; two") && !Catch::Contains("\n"));
    std::signal(SIGXFSZ, previous);
    CHECK_FALSE(fs::exists(folder.file("a.mp4")));
}

TEST_CASE("To install ffmpeg is no advice when there is one that cannot be started") {
    const Folder folder;
    render::VideoOptions options{folder.file("a.mp4"), {16, 16}};
    options.ffmpeg = folder.file("no-program");
    std::ofstream(options.ffmpeg) << "no permission to run it";
    CHECK_THROWS_WITH(render::requireEncoder(options),
                      Catch::Contains("Permission denied") && !Catch::Contains("install"));
    rlimit files = {};
    REQUIRE(::getrlimit(RLIMIT_NOFILE, &files) == 0);
    const rlimit none = {0, files.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_NOFILE, &none) == 0);
    CHECK_THROWS_WITH(render::requireEncoder(options),
                      Catch::Contains("Too many open files") && !Catch::Contains("install"));
    ::setrlimit(RLIMIT_NOFILE, &files);
}

TEST_CASE("An encoder that outlived its run does not write into the next run's video") {
    const Folder folder;
    writeVideo({folder.file("whole.mp4"), {64, 64}, {30}}, 3);
    const std::string abandoned = folder.file(".a.mp4.abc123.partial");
    std::ofstream old(abandoned);
    old << "old" << std::flush;
    render::VideoWriter writer({folder.file("a.mp4"), {64, 64}, {30}});
    CHECK_FALSE(fs::exists(abandoned));  // no lock: its run has ended
    for (int k = 0; k < 3; ++k) writer.add(frame({64, 64}, k));
    old << std::string(1000, 'x') << std::flush;
    writer.finish();
    CHECK(bytesOf(folder.file("a.mp4")) == bytesOf(folder.file("whole.mp4")));
}

TEST_CASE("Two writers of one video both succeed, and the last to finish wins") {
    const Folder folder;
    writeVideo({folder.file("three.mp4"), {64, 64}, {30}}, 3);
    render::VideoWriter first({folder.file("a.mp4"), {64, 64}, {30}});
    render::VideoWriter second({folder.file("a.mp4"), {64, 64}, {30}});
    for (int k = 0; k < 3; ++k) first.add(frame({64, 64}, k));
    second.add(frame({64, 64}, 0));
    second.finish();
    first.finish();
    CHECK(bytesOf(folder.file("a.mp4")) == bytesOf(folder.file("three.mp4")));
    CHECK(folder.entryCount() == 2);
}

TEST_CASE("A video keeps the permissions of the file that it replaces, and may have a name of 250 bytes") {
    const Folder folder;
    const std::string name = std::string(246, 'v').append(".mp4");
    writeVideo({folder.file(name), {64, 64}, {30}}, 1);
    fs::permissions(folder.file(name), fs::perms::owner_read);
    writeVideo({folder.file(name), {64, 64}, {30}}, 1);
    CHECK(fs::status(folder.file(name)).permissions() == fs::perms::owner_read);
}

TEST_CASE("The messages of ffmpeg may have any length") {
    const Folder folder;
    render::VideoOptions options{folder.file("a.mp4"), {64, 64}};
    options.ffmpeg = fakeFfmpeg(folder, "head -c 1000000 /dev/zero | tr '\\0' 'x' >&2; cat > /dev/null; exit 1");
    CHECK_THROWS_WITH(writeVideo(options, 3), Catch::Contains("exit status 1"));
}

TEST_CASE("A folder that does not exist is named, with the reason") {
    CHECK_THROWS_WITH(writeVideo({"/nowhere/a.mp4", {64, 64}}, 2),
                      Catch::Contains("/nowhere/a.mp4") && Catch::Contains("No such file"));
}

TEST_CASE("A video that is not finished leaves no file") {
    const Folder folder;
    {
        render::VideoWriter writer({folder.file("a.mp4"), {64, 64}, {30}});
        for (int k = 0; k < 5; ++k) writer.add(frame({64, 64}, k));
    }
    CHECK(folder.entryCount() == 0);
}
