#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <place/match/team.hpp>

struct MpiCalls;

namespace retrace {

/// The processes that mpirun started.
class LaunchedTeam final : public place::Team {
 public:
  explicit LaunchedTeam(const MpiCalls& calls);
  ~LaunchedTeam() override;
  LaunchedTeam(const LaunchedTeam&) = delete;
  LaunchedTeam& operator=(const LaunchedTeam&) = delete;

  [[nodiscard]] std::size_t size() const override;
  [[nodiscard]] std::size_t rank() const override;
  std::vector<Message> exchange(std::span<const std::uint8_t> message) override;
  std::vector<Message> collect(std::span<const std::uint8_t> message) override;

  /// Tells the others that this one failed, so that all end; where they know already, does nothing.
  void fail(const std::string& what);
  /// Bytes that this member gave to others.
  [[nodiscard]] std::uint64_t bytes_sent() const { return bytes_sent_; }

 private:
  std::vector<Message> gather(std::span<const std::uint8_t> message, bool to_everyone);

  const MpiCalls& calls_;
  bool failed_ = false;
  std::uint64_t bytes_sent_ = 0;
};

/// True if the program was started by mpirun as one of several processes.
bool is_launched();

/// The team, if `is_launched`; null otherwise. Throws `vo::Error` if this build has no MPI.
std::unique_ptr<LaunchedTeam> launched_team();

/// The share of the machine's processors that one process should use; 0 (all) without a team.
int threads_of_each();

}  // namespace retrace
