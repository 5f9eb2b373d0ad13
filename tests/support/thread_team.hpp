#pragma once

#include <barrier>
#include <exception>
#include <functional>
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
          board.all_are_here.arrive_and_drop();  // the others do not wait for it
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    for (const std::exception_ptr& failure : failures)
      if (failure) std::rethrow_exception(failure);
  }

 private:
  struct Board {
    explicit Board(std::size_t size) : messages(size), all_are_here(static_cast<std::ptrdiff_t>(size)) {}
    std::vector<place::Team::Message> messages;
    std::barrier<> all_are_here;
  };

  class Member final : public place::Team {
   public:
    Member(Board& board, std::size_t rank) : board_(board), rank_(rank) {}
    [[nodiscard]] std::size_t size() const override { return board_.messages.size(); }
    [[nodiscard]] std::size_t rank() const override { return rank_; }
    std::vector<Message> exchange(std::span<const std::uint8_t> message) override {
      board_.messages[rank_].assign(message.begin(), message.end());
      board_.all_are_here.arrive_and_wait();
      std::vector<Message> all = board_.messages;
      board_.all_are_here.arrive_and_wait();
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
