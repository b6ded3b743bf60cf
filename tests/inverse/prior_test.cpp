#include "inverse/prior/prior.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "forward/model/build_model.hpp"
#include "inverse/posterior/posterior.hpp"
#include "inverse/prior/prior_file.hpp"
#include "inverse/shape/infer.hpp"
#include "inverse/shape/objective.hpp"
#include "inverse/target/comparison.hpp"
#include "tests/inverse/pulled_tongue.hpp"

namespace genio {
namespace {

namespace fs = std::filesystem;

class PriorTest : public test::PulledTongue {
 protected:
  double activation(const Answer& a, const std::string& name) {
    for (const auto& c : a.muscles)
      if (c.name == name) return c.best / c.maximum;
    ADD_FAILURE() << name;
    return 0;
  }
  std::string file(const std::string& name, const std::string& text) {
    const fs::path folder = fs::temp_directory_path() / "genio_prior_test";
    fs::create_directories(folder);
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }
  std::string error(const std::string& path) {
    try {
      read_prior(path);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
};

TEST_F(PriorTest, TermsAreTheirOwnDerivatives) {
  Prior prior;
  prior.emg["GGP"] = {0.2, 0.05};
  prior.symmetry_sd = 0.03;
  prior.cocontraction = Normal{0.1, 0.02};
  prior.parameters["elasticity.a10"] = {1000, 200};
  prior.head_pose = HeadPosePrior{1e-3, 0.02};
  const auto u = unknowns_of(m, prior, false);
  const PriorTerms t = prior_terms(prior, u);
  const Vector z = Vector::Random(Eigen::Index(u.size())), d = Vector::Random(z.size());
  const double h = 1e-4;
  EXPECT_NEAR((t.value(z + h * d) - t.value(z - h * d)) / (2 * h), t.gradient(z).dot(d),
              1e-8 * t.gradient(z).norm());
  EXPECT_NEAR(((t.gradient(z + h * d) - t.gradient(z - h * d)) / (2 * h) - t.hessian() * d).norm(),
              0, 1e-7 * (t.hessian() * d).norm());
}

TEST_F(PriorTest, ABeliefMayBeCutOffWithinTheBoundsOfItsParameter) {
  Prior prior;
  prior.parameters["elasticity.a10"] = {{1000, 200}, 900, 1e9};
  const Unknown c = unknowns_of(m, prior, false).back();
  EXPECT_NEAR(c.lower * c.scale, 900, 1e-9);
  const auto& info = m.parameters[size_t(c.parameters.front())].info;
  EXPECT_LE(c.upper * c.scale, info.upper * (1 + 1e-12));
  prior.parameters["elasticity.a10"] = {{1000, 200}, 1100};
  EXPECT_THROW(unknowns_of(m, prior, false), InputError);
}

TEST_F(PriorTest, AFactorIsBelievedInByItsLogarithm) {
  ModelDescription d = read_description(test::generic_model());
  d.effects["stiff_region"] = {{"factor", 2.0}, {"x", 0.1}, {"y", 0}, {"z", 0.1}, {"radius", 0.02}};
  const Model scarred = build_model(d, "scarred");
  Prior prior;
  prior.parameters["stiff_region.factor"] = {{1, 0.7}, 0.25, 8, true};
  const auto u = unknowns_of(scarred, prior, true);
  const PriorTerms t = prior_terms(prior, u);
  const Unknown& c = u.back();
  EXPECT_NEAR(c.value(c.lower), 0.25, 1e-12);
  EXPECT_NEAR(c.value(c.upper), 8, 1e-12);
  EXPECT_NEAR(c.value(c.z_of(3)), 3, 1e-12);
  EXPECT_NEAR(c.slope(3), (c.value(c.z_of(3) + 1e-6) - c.value(c.z_of(3) - 1e-6)) / 2e-6,
              1e-6 * c.slope(3));
  Vector z = Vector::Zero(Eigen::Index(u.size()));
  EXPECT_NEAR(t.value(z), 0, 1e-12);
  z[z.size() - 1] = c.z_of(4);
  EXPECT_NEAR(t.value(z), 0.5 * std::pow(std::log(4) / 0.7, 2), 1e-9);
  z[z.size() - 1] = c.z_of(0.25);
  EXPECT_NEAR(t.value(z), 0.5 * std::pow(std::log(4) / 0.7, 2), 1e-9);
  EXPECT_EQ(apply_unknowns(u, z, default_parameters(scarred))[c.parameters.front()],
            c.value(c.z_of(0.25)));
}

TEST_F(PriorTest, DensityKnowsWhatIsFixed) {
  Prior prior;
  prior.symmetry_sd = 1e-3;
  prior.fixed["GGP_L"] = 0.2 * m.parameters[size_t(command_parameters(m, "GGP_L")[0])].info.upper;
  const auto u = unknowns_of(m, prior, false);
  const PriorTerms t = prior_terms(prior, u);
  const auto open = t.open();
  ASSERT_EQ(open.size(), u.size() - 1);
  const Vector mean = sample(density_of(t), 2000).rowwise().mean();
  for (size_t i = 0; i < open.size(); ++i)
    if (u[size_t(open[i])].name == "GGP_R") {
      EXPECT_NEAR(mean[Eigen::Index(i)], 0.2, 1e-2);
    }
}

TEST_F(PriorTest, SymmetryTiesTheSides) {
  Prior prior;
  prior.symmetry_sd = 1e-3;
  const auto u = unknowns_of(m, prior, false);
  const PriorTerms t = prior_terms(prior, u);
  Vector even = Vector::Zero(Eigen::Index(u.size())), odd = even;
  for (size_t i = 0; i < u.size(); ++i)
    if (bilateral_name(u[i].name) == "GGP") {
      even[Eigen::Index(i)] = 0.1;
      odd[Eigen::Index(i)] = u[i].name == "GGP_L" ? 0.1 : -0.1;
    }
  EXPECT_GT(t.value(odd), 1e3 * t.value(even));
}

TEST_F(PriorTest, FixedMusclesStayWhereTheyAre) {
  Prior prior;
  prior.fixed["MH"] = 0;
  prior.fixed["GGP"] = 2.5;
  const Answer a = infer(m, pulled({{"GGP", 2.5}, {"SL", 0.8}}, 30, 1e-3), prior, ws);
  ASSERT_EQ(a.status, InferStatus::converged) << a.message;
  for (const auto& c : a.muscles) {
    if (c.name != "MH" && c.name != "GGP") continue;
    EXPECT_TRUE(c.fixed);
    EXPECT_NEAR(c.best, c.name == "GGP" ? 2.5 : 0, 1e-9);
    EXPECT_EQ(c.sd, 0);
    EXPECT_EQ(c.low, c.high);
  }
  EXPECT_LT(1e3 * a.rms, 0.1);
}

TEST_F(PriorTest, EmgDecidesWhatTheShapeLeavesOpen) {
  const Target t = pulled({{"GGP", 4}, {"TRANS", 2}}, 30, 1e-3);
  Prior prior;
  prior.emg["MH"] = {0.3, 0.01};
  const Answer without = infer(m, t, Prior{}, ws), with = infer(m, t, prior, ws);
  EXPECT_LT(activation(without, "MH"), 0.1);
  EXPECT_NEAR(activation(with, "MH"), 0.3, 0.03);
}

TEST_F(PriorTest, CocontractionSetsTheMeanActivation) {
  const Target t = pulled({{"GGP", 2}}, 30, 1e-3);
  Prior prior;
  prior.cocontraction = Normal{0.1, 0.002};
  const Answer a = infer(m, t, prior, ws);
  double sum = 0;
  for (const auto& c : a.muscles) sum += c.best / c.maximum / double(a.muscles.size());
  EXPECT_NEAR(sum, 0.1, 0.01);
}

TEST_F(PriorTest, AMovedHeadIsFoundAlong) {
  Target t = pulled({{"GGP", 3}, {"SL", 1}}, 30, 3e-4);
  for (auto& p : t.curve) p.position += Vec2(1.5e-3, -1e-3);
  Prior prior;
  prior.head_pose = HeadPosePrior{2e-3, 0.02};
  const Answer a = infer(m, t, prior, ws);
  ASSERT_EQ(a.others.size(), 3u);
  EXPECT_EQ(a.verdict, Verdict::explained);
  EXPECT_NEAR(a.others[0].best, -1.5e-3, 3 * a.others[0].sd);
  EXPECT_NEAR(a.others[1].best, 1e-3, 3 * a.others[1].sd);
  EXPECT_LT(a.others[0].sd, 4e-3);
}

TEST_F(PriorTest, HessianCountsParametersAndPoseToo) {
  ModelDescription d = read_description(test::generic_model());
  d.effects["jaw_opening"] = {{"angle", 1.0}};
  d.effects["stiff_region"] = {{"factor", 2.0}, {"x", 0.1}, {"y", 0}, {"z", 0.1}, {"radius", 0.02}};
  const Model jaw = build_model(d, "generic");
  Workspace own(jaw);
  Prior prior;
  prior.parameters["jaw_opening.angle"] = {1, 3};
  prior.parameters["stiff_region.factor"] = {{1, 1}, 0.1, 10, true};
  prior.head_pose = HeadPosePrior{2e-3, 0.05};
  Target t = curve_target(jaw, jaw.rest, 30, 1e-3);
  for (auto& p : t.curve) p.position += Vec2(1e-3, 2e-3);
  const Comparison comparison(jaw, t);
  const InferOptions options;
  Objective objective(jaw, comparison, prior, options, own);
  for (const double at : {0.03, 0.06}) {  // at the second the jaw presses on the tongue
    const Vector z = Vector::Constant(Eigen::Index(objective.unknowns().size()), at);
    const Matrix hessian = objective.exact_hessian(*objective.derivatives(z));
    for (Eigen::Index k = z.size() - 6; k < z.size(); ++k) {
      const double h = 1e-4;
      const Vector up = objective.derivatives(z + h * Vector::Unit(z.size(), k))->gradient;
      const Vector down = objective.derivatives(z - h * Vector::Unit(z.size(), k))->gradient;
      EXPECT_LT(((up - down) / (2 * h) - hessian.col(k)).norm(), 2e-3 * hessian.col(k).norm())
          << objective.unknowns()[size_t(k)].name << " at " << at;
    }
  }
}

TEST_F(PriorTest, FilesSayWhatIsWrongAndWhere) {
  EXPECT_NE(error(file("a.csv", "muscle,mean,sd\nGGP,2,0.1\n")).find("a.csv:2"), std::string::npos);
  EXPECT_NE(error(file("b.csv", "muscle,average\n")).find("expected muscle,mean,sd"),
            std::string::npos);
  EXPECT_NE(error(file("c.toml", "effort = 1\n")).find("did you mean effort_sd"),
            std::string::npos);
  EXPECT_NE(error(file("d.toml", "[cocontraction]\nmean = 0.1\n")).find("'sd' is missing"),
            std::string::npos);
  file("emg.csv", "muscle,mean,sd\nGGP,0.2,0.1\n");
  const Prior p = read_prior(file("e.toml",
                                  "effort_sd = 0.3\nemg = \"emg.csv\"\n[fixed_N]\nMH = 0.5\n"
                                  "[parameter.\"jaw_opening.angle\"]\nmean = 2\nsd = 1\n"
                                  "[head_pose]\nshift_sd_mm = 2\nturn_sd_deg = 3\n"));
  EXPECT_EQ(p.effort_sd, 0.3);
  EXPECT_EQ(p.emg.at("GGP").mean, 0.2);
  EXPECT_EQ(p.fixed.at("MH"), 0.5);
  EXPECT_EQ(p.parameters.at("jaw_opening.angle").sd, 1);
  EXPECT_NEAR(p.head_pose->shift_sd, 2e-3, 1e-12);
  Prior wrong;
  wrong.emg["GPG"] = {0.1, 0.1};
  EXPECT_THROW(prior_terms(wrong, unknowns_of(m, wrong, true)), InputError);
  wrong = {};
  wrong.fixed["MH"] = 1e3;
  EXPECT_THROW(prior_terms(wrong, unknowns_of(m, wrong, true)), InputError);
}

void expect_same_emg(const Prior& a, const Prior& b) {
  ASSERT_EQ(names_in(a.emg), names_in(b.emg));
  for (const auto& [muscle, activation] : a.emg) {
    EXPECT_EQ(activation.mean, b.emg.at(muscle).mean) << muscle;
    EXPECT_EQ(activation.sd, b.emg.at(muscle).sd) << muscle;
  }
}

TEST_F(PriorTest, EmgMayStandInTheFileItself) {
  file("emg.csv", "muscle,mean,sd\nGGP,0.2,0.1\nTRANS_L,0,1e-3\n");
  const Prior beside = read_prior(file("beside.toml", "emg = \"emg.csv\"\n"));
  const Prior within = read_prior(file(
      "within.toml", "[emg.GGP]\nmean = 0.2\nsd = 0.1\n[emg]\nTRANS_L = {mean = 0, sd = 1e-3}\n"));
  expect_same_emg(beside, within);
  EXPECT_NE(error(file("f.toml", "[emg.GGP]\nmean = 2\nsd = 1\n")).find("from 0 to 1"),
            std::string::npos);
  EXPECT_NE(error(file("g.toml", "[emg]\n")).find("'emg' has no muscle"), std::string::npos);
  EXPECT_NE(error(file("h.toml", "\nemg = 7\n")).find("h.toml:2: 'emg' must be a string"),
            std::string::npos);
}

TEST_F(PriorTest, ATextIsReadAsAFileAndNamesNone) {
  const std::string text = "effort_sd = 0.3\n[emg.GGP]\nmean = 0.2\nsd = 0.1\n";
  const Prior sent = prior_of_text("prior", text), read = read_prior(file("i.toml", text));
  EXPECT_EQ(sent.effort_sd, read.effort_sd);
  expect_same_emg(sent, read);
  file("emg.csv", "muscle,mean,sd\nGGP,0.2,0.1\n");
  for (const auto& [wrong, said] :
       {std::pair("\n\neffort_sd = 0\n", "prior, line 3: 'effort_sd' must be above 0"),
        {"effort_sd =\n", "prior, line 1: "},
        {"emg = \"emg.csv\"\n", "prior, line 1: 'emg' names a file"}}) {
    try {
      prior_of_text("prior", wrong);
      ADD_FAILURE() << wrong;
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()).find(said), 0u) << e.what();
    }
  }
}

TEST_F(PriorTest, AFileAsTextSaysTheSameWithoutAnyOther) {
  const std::string csv = file("emg.csv", "muscle,mean,sd\nGGP,0.1234567890123456,1e-3\nHG,1,2\n");
  const std::string plain = "# of the first session\neffort_sd = 0.3\n";
  EXPECT_EQ(prior_text(file("j.toml", plain)), plain);
  const std::string named = file("k.toml",
                                 "emg = \"emg.csv\"\neffort_sd = 0.30000000000000004\n"
                                 "[parameter.\"jaw_opening.angle\"]\nmean = 2\nsd = 1\n");
  for (const std::string& path : {csv, named}) {
    const Prior read = read_prior(path), sent = prior_of_text("prior", prior_text(path));
    expect_same_emg(read, sent);
    EXPECT_EQ(read.effort_sd, sent.effort_sd);
    EXPECT_EQ(names_in(read.parameters), names_in(sent.parameters));
  }
}

}  // namespace
}  // namespace genio
