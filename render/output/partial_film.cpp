// A lock on the file itself, which the encoder does not mind.
#include "render/output/partial_film.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include <fmt/format.h>

#include "render/output/replaceable.h"
#include "render/picture/system_error.h"

namespace render {
namespace {

[[noreturn]] void fail(const std::string& what, int error) {
    throw SystemError(fmt::format("cannot {}: {}", what, std::generic_category().message(error)));
}

bool isLocked(int descriptor) {
    return ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

/// Throws SystemError when another run is writing it.
void removeOld(const std::string& path) {
    const int old = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (old < 0) return;
    const bool inUse = isLocked(old);
    ::close(old);
    if (inUse) throw SystemError(fmt::format("cannot write {}: another run is writing it", path));
    // The encoder of a run that was killed may still be at it: it keeps its file, we begin another.
    ::unlink(path.c_str());
}

}  // namespace

PartialFilm::PartialFilm(const std::string& film) : film_(replaceable(film)), path_(film_ + ".partial") {
    removeOld(path_);
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail("write " + path_, errno);
    // A file system without locks has none to respect.
    ::flock(descriptor_, LOCK_EX | LOCK_NB);
}

PartialFilm::~PartialFilm() {
    if (descriptor_ < 0) return;
    ::unlink(path_.c_str());
    ::close(descriptor_);
}

void PartialFilm::becomeFilm() {
    if (::fsync(descriptor_) != 0) fail("flush " + path_, errno);
    if (std::rename(path_.c_str(), film_.c_str()) != 0) fail(fmt::format("rename {} to {}", path_, film_), errno);
    ::close(descriptor_);
    descriptor_ = -1;
}

}  // namespace render
