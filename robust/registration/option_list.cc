// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/option_list.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <utility>

namespace quatro {
namespace {

template <typename Enum>
Choice ChoiceOf(std::initializer_list<std::pair<const char*, Enum>> names,
                Enum* field) {
  Choice choice;
  std::vector<Enum> values;
  for (const auto& [name, value] : names) {
    choice.names.emplace_back(name);
    values.push_back(value);
  }
  choice.get = [values, field] {
    return static_cast<std::size_t>(
        std::find(values.begin(), values.end(), *field) - values.begin());
  };
  choice.set = [values, field](std::size_t i) { *field = values[i]; };
  return choice;
}

Option PruningOption(Pruning* field) {
  return {"pruning",
          "",
          "how inconsistent matches are left out",
          ChoiceOf({{"clique_heuristic", Pruning::kCliqueHeuristic},
                    {"exact_clique", Pruning::kExactClique},
                    {"max_core", Pruning::kMaxCore},
                    {"none", Pruning::kNone}},
                   field)};
}

Option TimLayoutOption(TimLayout* field) {
  return {"tim_layout",
          "",
          "which pairs of matches give TIMs",
          ChoiceOf({{"ring", TimLayout::kRing},
                    {"complete", TimLayout::kComplete},
                    {"random", TimLayout::kRandom}},
                   field)};
}

Option CliqueTimeOption(double* field) {
  return {"clique_time_limit_seconds", "[s]", "for exact_clique", field};
}

Option CrosscheckOption(bool* field) {
  return {"crosscheck",
          "",
          "solve every weighted subproblem by Ceres too and report the largest "
          "difference; slow",
          field};
}

OptionList GncOptionList(GncOptions* o) {
  return {{"gnc_start",
           "",
           "residuals that GNC starts from",
           ChoiceOf({{"plain_fit", GncStart::kPlainFit},
                     {"identity", GncStart::kIdentity}},
                    &o->start)},
          {"gnc_mu_step", "> 1", "factor of mu per iteration", &o->mu_step},
          {"gnc_max_num_iterations",
           ">= 1",
           "iterations of GNC",
           &o->max_num_iterations}};
}

}  // namespace

void Append(OptionList more, OptionList* list) {
  list->insert(list->end(),
               std::make_move_iterator(more.begin()),
               std::make_move_iterator(more.end()));
}

OptionList CommonOptions(RegistrationOptions* o) {
  return {{"noise_bound",
           "[m], > 0",
           "largest residual of an inlier",
           &o->noise_bound},
          {"seed", ">= 0", "seed of everything that is random", &o->seed},
          {"num_threads",
           ">= 0",
           "0: one per core; never changes the answer",
           &o->num_threads},
          {"min_probability",
           "in [0, 1]",
           "probability of a correct pose that registered requires",
           &o->verdict.min_probability}};
}

OptionList FrontEndOptionList(RegistrationOptions* options) {
  FrontEndOptions* o = &options->front_end;
  return {{"voxel_size", "[m], > 0", "edge of a voxel", &o->voxel_size},
          {"normal_radius",
           "[m], > 0",
           "neighborhood of the normals",
           &o->normal_radius},
          {"fpfh_radius",
           "[m], normal_radius to 100 voxel_size",
           "neighborhood of the descriptors",
           &o->fpfh_radius},
          {"tuple_test",
           "",
           "reject matches that preserve no triangle",
           &o->tuple_test},
          {"tuple_scale",
           "in (0, 1)",
           "least ratio of the edges of a preserved triangle",
           &o->tuple.scale}};
}

OptionList RefinementOptionList(RegistrationOptions* options) {
  RefinementOptions* o = &options->refinement;
  return {{"refine",
           "",
           "local registration from the pose found",
           ChoiceOf({{"none", RefinementMethod::kNone},
                     {"icp", RefinementMethod::kIcp},
                     {"gicp", RefinementMethod::kGicp},
                     {"vgicp", RefinementMethod::kVgicp}},
                    &o->method)},
          {"refine_max_translation",
           "[m]",
           "a refinement that moves farther is rejected",
           &o->max_translation},
          {"refine_max_rotation",
           "[rad]",
           "a refinement that rotates farther is rejected",
           &o->max_rotation}};
}

OptionList SearchOptionList(RegistrationOptions* options) {
  PoseSearchOptions* o = &options->search;
  return {
      {"max_rung",
       "in [0, 3]",
       "how far other poses are searched if the first is not registered; "
       "0: not at all",
       &o->max_rung},
      {"search_time_limit_seconds",
       "[s], >= 0",
       "no rung or scale is begun later",
       &o->time_limit_seconds},
      {"max_num_proposals",
       ">= 1",
       "proposals of a consensus search",
       &o->max_num_proposals},
      {"num_aligned",
       ">= 1",
       "proposals that VG-ICP starts from",
       &o->num_aligned},
      {"search_max_tilt",
       "[rad], in [0, pi/4]",
       "tilt between the scans that the consensus search allows for",
       &o->max_tilt},
      {"bound_factor",
       "> 0",
       "bound of the consensus search over noise_bound",
       &o->bound_factor},
      {"consensus",
       "",
       "whether a consensus search of the matches proposes poses",
       &o->consensus},
      {"cliques", "", "whether the largest cliques propose poses", &o->cliques},
      {"segments",
       "",
       "whether walls, poles and clusters propose poses",
       &o->segments},
      {"geometric_choice",
       "",
       "whether the structure of the scans chooses among proposals",
       &o->geometric_choice},
      {"guided_matching",
       "",
       "whether the clouds are matched again near a pose that was searched",
       &o->guided_matching}};
}

OptionList InsOptionList(RegistrationOptions* options) {
  InsOptions* o = &options->ins;
  return {
      {"ins_mode",
       "",
       "how the attitudes of an INS are used",
       ChoiceOf({{"none", InsMode::kNone},
                 {"relative", InsMode::kRelative},
                 {"leveled", InsMode::kLeveled},
                 {"fused", InsMode::kFused}},
                &o->mode)},
      {"source_rpy",
       "[rad]",
       "roll, pitch and yaw of the source by the INS; x ahead, z up",
       AttitudeField{&o->source_attitude}},
      {"target_rpy",
       "[rad]",
       "roll, pitch and yaw of the target by the INS",
       AttitudeField{&o->target_attitude}},
      {"attitude_std",
       "[rad]",
       "standard deviation of each roll and pitch by the INS",
       &o->attitude_std},
      {"match_std",
       "[m]",
       "standard deviation of an inlier on each axis, for fused; 0: a third "
       "of noise_bound",
       &o->match_std},
      {"up", "unit vector", "which way is up in a level cloud", &o->up},
      {"gravity",
       "",
       "where the vertical comes from: as given; as given, then the scans; or "
       "the scans alone",
       ChoiceOf({{"given", Gravity::kGiven},
                 {"scans", Gravity::kScans},
                 {"none", Gravity::kNone}},
                &o->gravity)}};
}

OptionList BoundsOptionList(RegistrationOptions* options) {
  PoseBounds* o = &options->bounds;
  return {{"guess",
           "4x4",
           "prior on target_from_source; no motion if not given",
           &o->guess},
          {"max_translation",
           "[m], >= 0",
           "largest distance from the guess",
           &o->max_translation},
          {"max_yaw_deg",
           "[deg], in [0, 180]",
           "largest yaw from the guess",
           DegreesField{&o->max_yaw}},
          {"max_tilt_deg",
           "[deg], in [0, 180]",
           "largest tilt from the guess, with one of the bounds above",
           DegreesField{&o->max_tilt}}};
}

OptionList QuatroExactOptionList(RegistrationOptions* options) {
  QuatroOptions* o = &options->quatro;
  return {{"tim_bound_factor",
           "> 0",
           "bound of a TIM over noise_bound",
           &o->tim_bound_factor},
          {"consistency_test",
           "",
           "which lengths two consistent matches share",
           ChoiceOf({{"length", ConsistencyTest::kLength},
                     {"planar", ConsistencyTest::kPlanar},
                     {"planar_and_height", ConsistencyTest::kPlanarAndHeight}},
                    &o->consistency_test)},
          {"max_tilt", "[rad]", "for planar_and_height", &o->max_tilt},
          PruningOption(&o->pruning),
          CliqueTimeOption(&o->clique_time_limit_seconds),
          TimLayoutOption(&o->tim_layout),
          {"num_random_tims",
           ">= 1",
           "number of TIMs, for random",
           &o->num_random_tims},
          {"recover_translation",
           "",
           "estimate the translation again over all matches",
           &o->recover_translation},
          {"polish", "", "estimate roll and pitch on the inliers", &o->polish},
          {"polish_max_tilt",
           "[rad]",
           "a polish with a larger tilt is rejected",
           &o->polish_max_tilt},
          {"polish_max_rotation_std",
           "[rad]",
           "a polish with a less certain rotation is rejected",
           &o->polish_max_rotation_std},
          CrosscheckOption(&o->crosscheck)};
}

OptionList QuatroOptionList(RegistrationOptions* options) {
  QuatroOptions* o = &options->quatro;
  OptionList list = QuatroExactOptionList(options);
  list.push_back(
      {"yaw_solver",
       "",
       "which yaw is taken",
       ChoiceOf({{"gnc", YawSolver::kGnc}, {"exact", YawSolver::kExact}},
                &o->yaw_solver)});
  list.push_back({"surrogate",
                  "",
                  "loss of GNC",
                  ChoiceOf({{"truncated_least_squares",
                             SurrogateType::kTruncatedLeastSquares},
                            {"geman_mcclure", SurrogateType::kGemanMcClure},
                            {"welsch", SurrogateType::kWelsch}},
                           &o->surrogate)});
  Append(GncOptionList(&o->gnc), &list);
  list.push_back({"replace_missed_optimum",
                  "",
                  "take the exact yaw if that of GNC costs more",
                  &o->replace_missed_optimum});
  list.push_back({"certificate_tolerance",
                  ">= 0",
                  "by how much it must cost more",
                  &o->certificate_tolerance});
  return list;
}

OptionList ArcConsensusOptionList(RegistrationOptions* options) {
  ArcConsensusOptions* o = &options->arc_consensus;
  return {{"max_tilt", "[rad]", "tilt between the scans", &o->max_tilt},
          {"num_pairs", ">= 1", "pairs drawn at random", &o->num_pairs},
          {"min_planar_length_factor",
           ">= 0",
           "shorter pairs are ignored; over noise_bound",
           &o->min_planar_length_factor}};
}

OptionList ConsensusOptionList(RegistrationOptions* options) {
  return {{"max_tilt",
           "[rad]",
           "tilt between the scans",
           &options->consensus.max_tilt}};
}

OptionList TeaserOptionList(RegistrationOptions* options) {
  TeaserOptions* o = &options->teaser;
  OptionList list = {PruningOption(&o->pruning),
                     CliqueTimeOption(&o->clique_time_limit_seconds),
                     TimLayoutOption(&o->tim_layout)};
  Append(GncOptionList(&o->gnc), &list);
  list.push_back({"estimate_scale",
                  "",
                  "estimate the scale of the target over the source",
                  &o->estimate_scale});
  list.push_back({"num_scale_tims",
                  ">= 1",
                  "TIMs that the scale is estimated from",
                  &o->num_scale_tims});
  list.push_back(CrosscheckOption(&o->crosscheck));
  return list;
}

OptionList FgrOptionList(RegistrationOptions* options) {
  FgrOptions* o = &options->fgr;
  return {{"start_scale",
           "> 0",
           "root of the first mu over the radius of the clouds",
           &o->start_scale},
          {"mu_step", "> 1", "divisor of mu", &o->mu_step},
          {"iterations_per_mu", ">= 1", "steps per mu", &o->iterations_per_mu},
          {"max_iterations", ">= 1", "steps at most", &o->max_iterations},
          {"step_tolerance",
           "[rad] and radii, > 0",
           "length of the last step",
           &o->step_tolerance},
          {"start_at_plain_fit",
           "",
           "start from least squares over all matches",
           &o->start_at_plain_fit}};
}

OptionList RansacOptionList(RegistrationOptions* options) {
  RansacOptions* o = &options->ransac;
  return {{"max_iterations", ">= 1", "samples at most", &o->max_iterations},
          {"confidence",
           "in (0, 1]",
           "probability of having drawn an all-inlier sample",
           &o->confidence},
          {"local_optimization",
           "",
           "refit every new best pose",
           &o->local_optimization},
          {"sample",
           "",
           "what a pose is computed from",
           ChoiceOf({{"three_points", MinimalSample::kThreePoints},
                     {"two_points", MinimalSample::kTwoPoints}},
                    &o->minimal.sample)},
          {"edge_test",
           "",
           "what the edges of a sample must preserve",
           ChoiceOf({{"none", EdgeTest::kNone},
                     {"bound", EdgeTest::kBound},
                     {"ratio", EdgeTest::kRatio}},
                    &o->minimal.edge_test)},
          {"edge_similarity",
           "in (0, 1]",
           "least ratio of edges, for ratio",
           &o->minimal.edge_similarity},
          {"max_tilt", "[rad]", "for two_points", &o->minimal.max_tilt}};
}

OptionList LocalAlignmentOptionList(LocalAlignmentOptions* o) {
  return {
      {"max_correspondence_distance",
       "[m], > 0",
       "points farther apart do not correspond",
       &o->max_correspondence_distance},
      {"kernel",
       "",
       "loss of each error",
       ChoiceOf({{"none", RobustKernelType::kNone},
                 {"huber", RobustKernelType::kHuber},
                 {"cauchy", RobustKernelType::kCauchy},
                 {"geman_mcclure", RobustKernelType::kGemanMcClure}},
                &o->kernel.type)},
      {"kernel_width",
       "[m] for icp; see solvers/local/gicp.h, vgicp.h",
       "width of the kernel",
       &o->kernel.width},
      {"translation_tolerance",
       "[m], > 0",
       "translation of the last step",
       &o->translation_tolerance},
      {"rotation_tolerance",
       "[rad], > 0",
       "rotation of the last step",
       &o->rotation_tolerance},
      {"max_num_iterations", ">= 1", "steps at most", &o->max_num_iterations},
      {"min_conditioning",
       "in [0, 1)",
       "below it the pose is degenerate",
       &o->min_conditioning}};
}

}  // namespace quatro
