// Strategy: small series written and read back; growth and truncation. That a row
// allocates nothing is in no_allocation_test.cpp.
#include "hurcules/sim/recorder.hpp"

#include "hurcules/sim/events.hpp"
#include "support/expect.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

class RecorderTest : public testing::Test {
 protected:
  RecorderTest() {
    recorder_.add("time", &time_);
    recorder_.add("q", {"a", "b"}, q_);
  }
  void record(int rows) {
    recorder_.reserve(static_cast<std::size_t>(rows));
    for (int i = 0; i < rows; ++i) {
      q_ << 2.0 * time_, -time_;
      recorder_.record();
      time_ += 1.0;
    }
  }
  double time_ = 0.0;
  Vector q_ = Vector::Zero(2);
  Recorder recorder_;
};

TEST_F(RecorderTest, NamesChannelsOfAVectorByPrefix) {
  EXPECT_EQ(recorder_.channels(), (std::vector<std::string>{"time", "q/a", "q/b"}));
}

TEST_F(RecorderTest, KeepsEveryRowOverManyReservations) {
  for (int i = 0; i < 30; ++i) record(7);
  ASSERT_EQ(recorder_.rows(), 210U);
  const Vector a = recorder_.series(1);
  for (Index i = 0; i < a.size(); ++i) EXPECT_EQ(a[i], 2.0 * static_cast<double>(i));
  EXPECT_EQ(recorder_.at(209, 2), -209.0);
  EXPECT_EQ(error_text([&] { (void)recorder_.at(210, 2); }),
            "a log of 210 rows and 3 channels has no row 210 of channel 2");
  EXPECT_TRUE(contains(error_text([&] { (void)recorder_.series(3); }), "of channel 3"));
}

TEST_F(RecorderTest, RefusesARowWithoutRoom) {
  EXPECT_TRUE(contains(error_text([&] { recorder_.record(); }), "wants room"));
}

TEST_F(RecorderTest, SnapshotIsWhatTheSourcesHoldNow) {
  q_ << 3.0, 4.0;
  EXPECT_TRUE(near(recorder_.snapshot(), Vector3(0.0, 3.0, 4.0), 0.0));
}

TEST_F(RecorderTest, ForgetsRowsFromATimeOn) {
  record(10);
  recorder_.truncate(6.0);
  EXPECT_EQ(recorder_.rows(), 6U);
  recorder_.truncate(100.0);
  EXPECT_EQ(recorder_.rows(), 6U);
  recorder_.truncate(0.0);
  EXPECT_EQ(recorder_.rows(), 0U);
}

TEST_F(RecorderTest, RefusesNewChannelsOnceItRecorded) {
  record(1);
  EXPECT_TRUE(contains(error_text([&] { recorder_.add("late", &time_); }), "before the first row"));
}

TEST(EventList, CountsWhatItHasNoRoomFor) {
  EventList events;
  for (int i = 0; i < 5000; ++i) events.add({1e-3 * i, EventKind::LimitMet, 0, 1});
  EXPECT_EQ(events.events().size() + events.lost(), 5000U);
  events.truncate(1.0);
  EXPECT_EQ(events.events().size(), 1000U);
}

}  // namespace
