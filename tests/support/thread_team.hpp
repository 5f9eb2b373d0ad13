#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include <place/match/team.hpp>

namespace test_support {

/// A team whose members are threads of this process.
class ThreadTeam {
 public:
  /// Runs `body` as each of `size` members and returns when all are done. Rethrows the failure
  /// of the first member that failed.
  static void run(std::size_t size, const std::function<void(place::Team&)>& body) {
    Board board(size);
    std::vector<std::exception_ptr> failures(size);
    std::vector<std::thread> threads;
    for (std::size_t rank = 0; rank < size; ++rank) {
      threads.emplace_back([&, rank] {
        Member member(board, rank);
        try {
          body(member);
        } catch (...) {
          failures[rank] = std::current_exception();
          board.members.leave();  // the others do not wait for it
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    for (const std::exception_ptr& failure : failures)
      if (failure) std::rethrow_exception(failure);
  }

 private:
  /// What std::barrier does, by a mutex: ThreadSanitizer sees what that orders in tests that are not
  /// instrumented.
  class Barrier {
   public:
    explicit Barrier(std::size_t size) : expected_(size) {}
    void arrive_and_wait() {
      std::unique_lock lock(mutex_);
      const std::size_t phase = phase_;
      ++arrived_;
      complete();
      changed_.wait(lock, [&] { return phase_ != phase; });
    }
    void leave() {
      const std::scoped_lock lock(mutex_);
      --expected_;
      complete();
    }

   private:
    void complete() {
      if (arrived_ < expected_) return;
      arrived_ = 0;
      ++phase_;
      changed_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::size_t expected_, arrived_ = 0, phase_ = 0;
  };

  struct Board {
    explicit Board(std::size_t size) : messages(size), members(size) {}
    std::vector<place::Team::Message> messages;
    Barrier members;
  };

  class Member final : public place::Team {
   public:
    Member(Board& board, std::size_t rank) : board_(board), rank_(rank) {}
    [[nodiscard]] std::size_t size() const override { return board_.messages.size(); }
    [[nodiscard]] std::size_t rank() const override { return rank_; }
    std::vector<Message> exchange(std::span<const std::uint8_t> message) override {
      board_.messages[rank_].assign(message.begin(), message.end());
      board_.members.arrive_and_wait();
      std::vector<Message> all = board_.messages;
      board_.members.arrive_and_wait();
      return all;
    }
    std::vector<Message> collect(std::span<const std::uint8_t> message) override {
      std::vector<Message> all = exchange(message);
      if (rank_ != 0) all.clear();
      return all;
    }

   private:
    Board& board_;
    std::size_t rank_;
  };
};

}  // namespace test_support
