// The page of the study of pictures: plots, the table, and how to have them again, in one HTML file.
#pragma once

#include <string>
#include <vector>

#include "studies/pictures/flicker.h"
#include "studies/pictures/pictures.h"
#include "studies/pictures/surface_smoothing.h"

namespace tools {

/// The plots as SVG.
struct PicturePlots {
    std::string times;
    std::string errors;
};

/// All that the study found.
struct PictureResults {
    std::vector<studies::PictureRow> rows;
    std::vector<studies::FlickerRow> flicker;
    std::vector<studies::SmoothingRow> smoothing;
};

std::string picturesPage(const PictureResults& results, const PicturePlots& plots, const std::string& command);

}  // namespace tools
