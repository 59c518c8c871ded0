// Bakes by the exact kernel, layer by layer (D22), for small scenes.
#pragma once

#include "fastpath/bakes/baker.h"

namespace clues::validate {

// As fastpath::bakes::fast_lister(). What only blocks is asked about, too, since cells may be mapped in a node's list. Guesses are passed over.
fastpath::bakes::ListerMaker exact_lister();

}  // namespace clues::validate
