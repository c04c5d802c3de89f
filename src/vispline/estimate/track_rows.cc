#include "vispline/estimate/track_rows.h"

#include "vispline/estimate/track_columns.h"
#include "vispline/estimate/track_kernel.h"

namespace vispline {
namespace {

using namespace track_kernel;

void set_residual(const std::optional<Seen>& seen, SightingRows& rows) {
  rows.lost = !seen;
  rows.r = seen ? Vector2d(seen->root * seen->r) : Vector2d(Vector2d::Zero());
  rows.squares = seen ? seen->r.squaredNorm() : kLostSigmas * kLostSigmas;
}

class SightingsLinearizer {
 public:
  SightingsLinearizer(const State& state, const Columns& columns, const TrackModel& model, const Track& track,
                      const Reference& reference)
      : state_(state),
        cameras_(columns.parameters.cameras),
        model_(model),
        track_(track),
        local_(state, columns, track),
        Q_(rows_of(reference, model, camera(0))),
        Q_l_(landmark_columns(reference.anchor, model, state.landmarks[track.landmark].bearing_c)),
        reference_columns_(local_.columns_of(0)) {}

  void view(std::size_t i, const Seen& seen, const KnotRows<2>& d_knots, SightingRows& rows) const {
    const ViewRows<2> A = rows_of(state_, camera(i), track_.sightings[i], seen, d_knots);
    const Eigen::Matrix<double, 2, 4> q = seen.root * seen.scale * seen.image.d_point;
    rows.column = local_.columns_of(i);
    rows.column.insert(rows.column.end(), reference_columns_.begin(), reference_columns_.end());
    rows.J.resize(2, A.size + Q_.size);
    rows.J.leftCols(A.size) = A.J_t().transpose();
    rows.J.rightCols(Q_.size) = Q_.J_t().lazyProduct(q.transpose()).transpose();
    rows.J_landmark.leftCols(model_.size()) = q * Q_l_;
  }

  /// Only the bearing and the lens move the reference pixel.
  void reference_view(const ReferencePixel& pixel, SightingRows& rows) const {
    rows.J_landmark.leftCols<2>() = pixel.seen.root * pixel.seen.scale * pixel.d_bearing *
                                    plane_across(state_.landmarks[track_.landmark].bearing_c);
    rows.column.clear();
    if (camera(0).intrinsics < 0) return;
    for (int i = 0; i < static_cast<int>(pixel.d_lens.cols()); ++i) rows.column.push_back(camera(0).intrinsics + i);
    rows.J = pixel.seen.root * pixel.seen.scale * pixel.d_lens;
  }

 private:
  const CameraColumns& camera(std::size_t i) const { return cameras_[track_.sightings[i].camera]; }

  const State& state_;
  const std::vector<CameraColumns>& cameras_;
  const TrackModel& model_;
  const Track& track_;
  TrackColumns local_;
  ViewRows<4> Q_;
  LandmarkRows Q_l_;
  std::vector<int> reference_columns_;
};

}  // namespace

void evaluate_sightings(const State& state, const Columns& columns, const TrackModel& model, const Track& track,
                        bool derivatives, std::vector<SightingRows>& all) {
  const Reference reference = reference_of(state, track, derivatives);
  std::optional<SightingsLinearizer> linearizer;
  if (derivatives) linearizer.emplace(state, columns, model, track, reference);
  all.resize(track.sightings.size());
  for (std::size_t i = 1; i < all.size(); ++i) {
    const Sighting& s = track.sightings[i];
    if (derivatives) {
      const auto [seen, d_knots] = see(state, model, s, reference.anchor.point, nullptr);
      set_residual(seen, all[i]);
      if (seen) linearizer->view(i, *seen, d_knots, all[i]);
    } else {
      const PoseSample at = state.curve->sample(instant_of(state, s), false);
      set_residual(see(state, model, s, at.T_w_b, at.twist_b, reference.anchor.point, nullptr), all[i]);
    }
  }
  if (model.unknowns == LandmarkUnknowns::kInverseDepth) return;
  const auto pixel = reference_pixel(state, model, track, reference, nullptr);
  set_residual(pixel ? std::optional(pixel->seen) : std::nullopt, all[0]);
  if (pixel && derivatives) linearizer->reference_view(*pixel, all[0]);
}

}  // namespace vispline
