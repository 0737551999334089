// The page of the study of pictures: plots, the table, and how to have them again, in one HTML file.
#pragma once

#include <string>
#include <vector>

#include "studies/pictures.h"

namespace tools {

/// The plots as SVG.
struct PicturePlots {
    std::string times;
    std::string errors;
};

std::string picturesPage(const std::vector<studies::PictureRow>& rows, const PicturePlots& plots,
                         const std::string& command);

}  // namespace tools
