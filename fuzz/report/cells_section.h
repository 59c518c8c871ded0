// What `clues check --all-cells --json` wrote, as a section of the page: sums for the level, a row for each cell, with the witnesses of its holes.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "fuzz/report/html_report.h"

namespace clues::fuzz {

// Of format "clues-check-cells/1". Throws as json_fields.h.
ReportSection cells_section(const nlohmann::json& report);

}  // namespace clues::fuzz
