// Campaigns against a subject that hides something visible: the tests fail unless it is found, and made small.
#pragma once

#include "fuzz/campaign/campaign.h"

namespace clues::fuzz {

// The campaign ends at the first finding.
void is_found_and_shrunk(CampaignOptions options, const Subject& subject);

// By the first cases of the random scenes.
void is_found_soon(const Subject& subject, std::uint64_t within);

}  // namespace clues::fuzz
