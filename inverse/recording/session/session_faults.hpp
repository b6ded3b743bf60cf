#pragma once
// What makes a recording doubtful beside its registration. Not for other rooms.

#include "inverse/recording/session/session.hpp"

namespace genio {

/// True where the contours lie on the palate's own trace, in the numbers of the device: no tongue
/// does along four fifths of what is seen of it.
bool is_the_palate(const ContourFile& target, const ContourFile& palate);

/// One palate does not register two heads: throws InputError where both files name speakers and
/// share none. Names count up to a comma, as "S1" may be "S1, Ann" in another table.
void check_same_speaker(const SessionFile& target, const SessionFile& palate);

/// How far marked points lie, once they are registered, from where they are glued at rest, each in
/// the middle of its places [m].
std::vector<Vec2> place_offsets(const Model& model, const ContourFile& file, const Similarity& s);

/// The same file with its sensors named in the other order along the tongue: who names them from
/// the root turns the head. Empty of frames where it has fewer than two.
ContourFile in_other_order(const Model& model, ContourFile file);

/// What contradicts the places of sensors: that of place_contradiction(), with the scale that the
/// palate tells where there is one, or places far from where the sensors lie once they are
/// registered. Empty where nothing does.
std::string doubtful_places(const Model& model, const ContourFile& turned,
                            const Registration& registration, bool by_palate);
/// What is seldom so of the places: distances that the tissue would have to be stretched for as it
/// seldom is. For a remark; empty where there is nothing.
std::string unlikely_places(const Model& model, const ContourFile& turned,
                            const Registration& registration, bool by_palate);

}  // namespace genio
