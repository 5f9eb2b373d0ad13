#include "place/match/candidates.hpp"

#include "place/match/team.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Sums over blocks of `pool` x `pool` pixels, smaller at the right and lower borders; a row for each image.
Rows pooled(const vo::ImageStack& images, std::size_t first, std::size_t count, std::size_t pool) {
  const auto width = static_cast<std::size_t>(images.width), height = static_cast<std::size_t>(images.height);
  const std::size_t across = (width + pool - 1) / pool, down = (height + pool - 1) / pool;
  Rows rows(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(across * down));
  std::vector<std::uint32_t> column_sums(width);
  for (std::size_t i = 0; i < count; ++i) {
    float* block = rows.row(static_cast<Eigen::Index>(i)).data();
    const std::uint8_t* pixels = images[first + i].data();
    for (std::size_t top = 0; top < height; top += pool) {
      std::ranges::fill(column_sums, 0);
      for (std::size_t y = top; y < std::min(height, top + pool); ++y)
        for (std::size_t x = 0; x < width; ++x) column_sums[x] += pixels[y * width + x];
      for (std::size_t left = 0; left < width; left += pool) {
        std::uint32_t sum = 0;
        for (std::size_t x = left; x < std::min(width, left + pool); ++x) sum += column_sums[x];
        *block++ = static_cast<float>(sum);
      }
    }
  }
  return rows;
}

std::vector<std::size_t> evenly_spaced(std::size_t count, std::size_t of) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < count; ++i) indices.push_back(i * of / count);
  return indices;
}

/// For each query, the indices of its `count` nearest references; rows of `width` values.
std::vector<std::size_t> nearest(std::vector<float>& queries, std::vector<float>& references,
                                 std::size_t width, std::size_t count, const CandidateOptions& options) {
  const auto matrix = [&](std::vector<float>& rows, std::size_t first, std::size_t number) {
    return flann::Matrix<float>(rows.data() + first * width, number, width);
  };
  // The single tree: the randomised ones cannot be seeded and give a different result every time.
  flann::KDTreeSingleIndex<flann::L2<float>> index(matrix(references, 0, references.size() / width),
                                                   flann::KDTreeSingleIndexParams());
  index.buildIndex();
  const std::size_t total = queries.size() / width;
  std::vector<std::size_t> found(total * count);
  constexpr std::size_t kBlock = 16;
  vo::parallel_for((total + kBlock - 1) / kBlock, [&](std::size_t block) {
    const std::size_t first = block * kBlock, number = std::min(kBlock, total - first);
    std::vector<float> distances(number * count);
    flann::Matrix<std::size_t> indices(found.data() + first * count, number, count);
    flann::Matrix<float> distance_matrix(distances.data(), number, count);
    flann::SearchParams params(flann::FLANN_CHECKS_UNLIMITED, static_cast<float>(options.slack));
    params.cores = 1;
    index.knnSearch(matrix(queries, first, number), indices, distance_matrix, count, params);
  });
  return found;
}

void check_candidate_options(const CandidateOptions& options) {
  if (options.pool_px < 1 || options.dimensions < 1 || options.sample < 1 || !(options.slack >= 0) ||
      options.shortlist < 1 || options.run < 1 || options.stretches < 1 || options.margin < 0) {
    throw std::invalid_argument("candidates: counts of at least 1, slack and margin of at least 0 expected");
  }
}

}  // namespace

/// The first principal components of images: a projection from pooled pixels.
struct CandidateFinder::Components {
  std::size_t pool = 1;
  Eigen::RowVectorXf mean;
  Eigen::MatrixXf axes;  ///< one column for each
};

CandidateFinder::CandidateFinder(const vo::ImageStack& sample, const CandidateOptions& options) {
  check_candidate_options(options);
  const auto pool = static_cast<std::size_t>(options.pool_px);
  Rows rows = pooled(sample, 0, sample.size(), pool);
  Components components{.pool = pool, .mean = rows.colwise().mean(), .axes = {}};
  rows.rowwise() -= components.mean;
  const Eigen::MatrixXf covariance = rows.transpose() * rows;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXf> solver(covariance);
  components.axes =
      solver.eigenvectors().rightCols(std::min<Eigen::Index>(options.dimensions, covariance.cols()));
  components_ = std::make_unique<const Components>(std::move(components));
}
CandidateFinder::~CandidateFinder() = default;
CandidateFinder::CandidateFinder(CandidateFinder&&) noexcept = default;
CandidateFinder& CandidateFinder::operator=(CandidateFinder&&) noexcept = default;

std::size_t CandidateFinder::dimensions() const {
  return static_cast<std::size_t>(components_->axes.cols());
}

std::vector<float> CandidateFinder::project(const vo::ImageStack& images) const {
  constexpr std::size_t kBlock = kShardBlock;  // so that a part's products are those of the whole
  std::vector<float> values(images.size() * dimensions());
  Eigen::Map<Rows> projected(values.data(), static_cast<Eigen::Index>(images.size()),
                             components_->axes.cols());
  vo::parallel_for((images.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
    const std::size_t first = block * kBlock, count = std::min(kBlock, images.size() - first);
    Rows rows = pooled(images, first, count, components_->pool);
    rows.rowwise() -= components_->mean;
    projected.middleRows(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(count)).noalias() =
        rows * components_->axes;
  });
  return values;
}

std::vector<std::size_t> candidate_sample(std::size_t references, const CandidateOptions& options) {
  return evenly_spaced(std::min(static_cast<std::size_t>(options.sample), references), references);
}

bool all_are_candidates(std::size_t references, const CandidateOptions& options) {
  return references <= static_cast<std::size_t>(options.sample);
}

std::vector<std::size_t> candidates(const vo::ImageStack& queries, const vo::ImageStack& references,
                                    const CandidateOptions& options) {
  if (queries.width != references.width || queries.height != references.height) {
    throw std::invalid_argument("candidates: query and reference descriptors differ in size");
  }
  check_candidate_options(options);
  const std::vector<std::size_t> sample = candidate_sample(references.size(), options);
  if (all_are_candidates(references.size(), options) || queries.empty()) return sample;
  const CandidateFinder finder(vo::select(references, sample), options);
  return finder.find(queries, finder.project(references), options);
}

std::vector<std::size_t> CandidateFinder::find(const vo::ImageStack& queries, std::vector<float> references,
                                               const CandidateOptions& options) const {
  const std::size_t total = references.size() / dimensions();
  std::vector<float> of_queries = project(queries);
  const std::size_t count = std::min<std::size_t>(static_cast<std::size_t>(options.shortlist), total);
  const std::vector<std::size_t> shortlists = nearest(of_queries, references, dimensions(), count, options);

  // Each run of queries votes for the block where its first query would be at equal pace. Votes for
  // neighbouring blocks count together, as a place may lie at their border.
  const auto run = static_cast<std::ptrdiff_t>(options.run),
             margin = static_cast<std::ptrdiff_t>(options.margin);
  const auto queries_total = static_cast<std::ptrdiff_t>(queries.size());
  std::vector<bool> kept(total, false);
  for (const std::size_t i : candidate_sample(total, options)) kept[i] = true;
  for (std::ptrdiff_t first = 0; first < queries_total; first += run) {
    std::map<std::ptrdiff_t, int> votes;
    for (std::ptrdiff_t q = first; q < std::min(queries_total, first + run); ++q) {
      for (std::size_t k = 0; k < count; ++k) {
        const auto r = static_cast<std::ptrdiff_t>(shortlists[static_cast<std::size_t>(q) * count + k]);
        const std::ptrdiff_t block = (r - (q - first) + run) / run;
        ++votes[block];
        ++votes[block + 1];
      }
    }
    std::vector<std::pair<int, std::ptrdiff_t>> ranked;
    for (const auto& [block, number] : votes) ranked.emplace_back(-number, block);
    std::ranges::sort(ranked);
    if (ranked.size() > static_cast<std::size_t>(options.stretches))
      ranked.resize(static_cast<std::size_t>(options.stretches));
    for (const auto& [number, block] : ranked) {
      // The run's first query lies in [(block - 2) * run, block * run), its last one run later.
      const std::ptrdiff_t begin = (block - 2) * run - margin, end = (block + 1) * run + margin;
      for (std::ptrdiff_t r = std::max<std::ptrdiff_t>(0, begin);
           r < std::min(end, static_cast<std::ptrdiff_t>(total)); ++r)
        kept[static_cast<std::size_t>(r)] = true;
    }
  }
  std::vector<std::size_t> indices;
  for (std::size_t r = 0; r < total; ++r) {
    if (kept[r]) indices.push_back(r);
  }
  return indices;
}

}  // namespace place
