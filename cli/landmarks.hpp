#pragma once
#include <map>
#include <string>
#include <vector>

#include "forward/model/model.hpp"

namespace genio::cli {

/// How far tip, dorsum or root has moved from rest [mm].
struct LandmarkShift {
  std::string name;
  Vec3 mm;
};

std::vector<LandmarkShift> landmark_shifts(const Model& model, const Positions& x);

/// Says of what anatomy's rest displacements are, where the model has modes that are not 0.
void print_anatomy(const std::map<std::string, double>& values);

void print_landmarks(const std::vector<LandmarkShift>& landmarks);

}  // namespace genio::cli
