#include "hurcules/sim/thread_pool.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <memory>
#include <stdexcept>
#include <vector>

namespace hurcules {
namespace {

int done_once(ThreadPool& pool) {
  std::vector<int> done(100, 0);
  pool.run(done.size(), [&](std::size_t i) { ++done[i]; });
  int once = 0;
  for (const int times : done) once += times == 1 ? 1 : 0;
  return once;
}

TEST(ThreadPool, DoesEachJobOnce) {
  for (const std::size_t threads : {1, 2, 3}) {
    ThreadPool pool(threads);
    EXPECT_EQ(done_once(pool), 100);
    EXPECT_EQ(done_once(pool), 100);
  }
}

TEST(ThreadPool, ThrowsWhatAJobThrewAndGoesOn) {
  ThreadPool pool(2);
  const auto fails = [](std::size_t i) {
    if (i == 7) throw std::runtime_error("seven");
  };
  EXPECT_THROW(pool.run(20, fails), std::runtime_error);
  EXPECT_EQ(done_once(pool), 100);
}

// its workers are the parent's: a child that waited for them would do so for ever
TEST(ThreadPool, WorksInAForkedChild) {
  auto pool = std::make_unique<ThreadPool>(3);
  EXPECT_EQ(done_once(*pool), 100);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    alarm(20);
    const bool works = done_once(*pool) == 100;
    pool.reset();
    _exit(works ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  EXPECT_EQ(done_once(*pool), 100);
}

}  // namespace
}  // namespace hurcules
