// The file that a film is written to until it is whole. Used by the writer of films.
#pragma once

#include <string>

namespace render {

/// FILM.partial, empty, for one run alone: the lock is the system's, and goes with the process however that ends.
class PartialFilm {
 public:
    /// Throws SystemError: the file cannot be made, the film is a folder, or another run is writing it.
    explicit PartialFilm(const std::string& film);
    /// Removes it unless it has become the film.
    ~PartialFilm();
    PartialFilm(const PartialFilm&) = delete;
    PartialFilm& operator=(const PartialFilm&) = delete;

    const std::string& path() const { return path_; }

    /// To the disk, then in the place of an older film. Throws SystemError.
    void becomeFilm();

 private:
    std::string film_;
    std::string path_;
    int descriptor_ = -1;
};

}  // namespace render
