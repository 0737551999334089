// The page of `globular gallery`: a card for each scene with its film, and docs/gallery.md from the same data.
#pragma once

#include <string>
#include <vector>

#include "tools/pages/gallery_entry.h"

namespace tools {

/// What the gallery says of the scenes in a folder of the library.
struct GalleryGroup {
    std::string folder;   ///< "paper"; empty: the top folder
    std::string heading;  ///< empty: none
    std::string text;     ///< Markdown of which HTML shows the words; empty: none
    std::vector<GalleryEntry> entries;
};

/// The page as HTML. It shows films and stills from the folder that it lies in, in which nothing else is needed.
std::string galleryPage(const std::vector<GalleryGroup>& groups);

/// The same as Markdown, for docs/gallery.md: its pictures are the stills, and its links lead to the scene files of the
/// repository.
/// @param command  the command line that prints it
std::string galleryMarkdown(const std::vector<GalleryGroup>& groups, const std::string& command);

}  // namespace tools
