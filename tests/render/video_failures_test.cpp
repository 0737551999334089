// Every way in which writing a video fails, and what happens to files when it does.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/catch.h"

#include <csignal>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "render/output/child_process.h"
#include "render/output/video.h"
#include "render/picture/system_error.h"
#include "tests/render/video_files.h"

using namespace video_files;

namespace {

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

TEST_CASE("An ffmpeg that works longer than the timeout is waited for", "[long]") {
    const Folder folder;
    render::VideoOptions options{folder.file("a.mp4"), {640, 360}};
    // Ten times as long as the steps of the work, so that a busy machine does not make one step seem none.
    options.progressTimeout = std::chrono::milliseconds(2000);
    const std::string work = "for k in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do sleep 0.2; echo >>$out; done";
    // After its input has ended it works for 3 s: its file changes, as when +faststart moves the index to the front.
    options.ffmpeg = fakeFfmpeg(folder, "cat >/dev/null; " + work);
    writeVideo(options, 3);
    CHECK(bytesOf(options.path).size() == 15);
    // One process that only computes for longer than the timeout.
    options.ffmpeg = fakeFfmpeg(folder, "exec perl -e 'while (<STDIN>) {} 1 while (times)[0] < 2.5'");
    writeVideo(options, 3);
    // A frame that takes as long: the input is not read meanwhile.
    options.ffmpeg = fakeFfmpeg(folder, work + "; cat >/dev/null");
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
