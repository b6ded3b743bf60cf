#pragma once
#include "inverse/recording/binary/data_tree.hpp"
#include "inverse/recording/samples/sensor_frames.hpp"

namespace genio {

/// Labels the table's samples with what MVIEW's array says was spoken then: by PHONES, else
/// SEGMENTS, else WORDS (LABEL and OFFS, two times in s), else by LABELS (NAME and OFFSET in ms,
/// each at the one sample nearest to it).
void label_samples(SensorTable& table, const DataTree& array);

/// A small file of MATLAB v5 with one trajectory, TT.
std::string mview_example();

}  // namespace genio
