// What the text of a level's entities says about its visibility: the keys of the first one, the world. The text is of the game; what cannot be read in it says
// nothing.
#pragma once

#include <string_view>

namespace clues::scene {

// How far the world is seen: the distance from portal to portal beyond which a compiler (q3map2) lists no cluster; 0 if none is given. A sight line that is no longer passes no two portals that are
// farther apart. Keys: _farplanedist, or fogclip, or distancecull, in large or small letters; the first that has a value; a number above 0.
double far_plane_in(std::string_view entities);

}  // namespace clues::scene
