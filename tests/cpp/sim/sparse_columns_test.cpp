// Strategy: a box on a plane and, beside it, a hinge that moves nothing there. Its column is added
// to the rows of the contacts; written out in full, the Jacobian must be the one of before, with
// room for the column where it was asked for and nowhere else. Then the arena is too small.
#include "hurcules/sim/sparse_columns.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "hurcules/robot/robot.hpp"
#include "support/scene.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;

// columns: 0 a hinge before, 1-6 the box, 7 and 8 hinges after; hinges have friction rows
constexpr int kBefore = 0, kBox = 1, kAfter = 7;

std::string scene(const std::string& memory) {
  return R"(<mujoco><option jacobian="sparse" cone="elliptic"/><size memory=")" + memory +
         R"("/><default><joint frictionloss="1"/></default><worldbody>
    <geom type="plane" size="5 5 1"/>
    <body pos="0 3 1"><joint axis="0 1 0"/><geom size="0.1"/></body>
    <body pos="0 0 0.0999"><freejoint/><geom type="box" size="0.1 0.1 0.1"/></body>
    <body pos="0 -3 1"><joint axis="0 1 0"/><geom size="0.1"/></body>
    <body pos="0 -4 1"><joint axis="0 1 0"/><geom size="0.1"/></body>
  </worldbody></mujoco>)";
}

class SparseColumns : public testing::Test {
 protected:
  void start(const std::string& memory) {
    model_ = load_model_text(scene(memory));
    data_.reset(mj_makeData(model_.get()));
    mj_step1(model_.get(), data_.get());
    added_.assign(static_cast<std::size_t>(data_->nefc), {});
  }
  bool add() { return add_sparse_columns(data_.get(), added_.data()); }
  AddedColumns& added(int row) { return added_[static_cast<std::size_t>(row)]; }
  [[nodiscard]] int first_contact_row() const { return data_->contact[0].efc_address; }
  // (nefc x nv)
  [[nodiscard]] std::vector<double> full() const {
    std::vector<double> rows(static_cast<std::size_t>(data_->nefc * model_->nv));
    for (int row = 0; row < data_->nefc; ++row) {
      for (int i = 0; i < data_->efc_J_rownnz[row]; ++i) {
        const int at = data_->efc_J_rowadr[row] + i;
        rows[static_cast<std::size_t>(row * model_->nv + data_->efc_J_colind[at])] =
            data_->efc_J[at];
      }
    }
    return rows;
  }
  // rows with the pattern of this one behind it, as the solver may put together
  [[nodiscard]] int alike(int row) const {
    int count = 0;
    const auto columns = [&](int r) {
      const int* const begin = data_->efc_J_colind + data_->efc_J_rowadr[r];
      return std::vector<int>(begin, begin + data_->efc_J_rownnz[r]);
    };
    for (int r = row + 1; r < data_->nefc && columns(r) == columns(row); ++r) ++count;
    return count;
  }

  ModelPtr model_;
  std::unique_ptr<mjData, void (*)(mjData*)> data_{nullptr, mj_deleteData};
  std::vector<AddedColumns> added_;
};

TEST_F(SparseColumns, HaveRoomForNewEntriesAndKeepTheOldOnes) {
  start("1M");
  ASSERT_EQ(data_->ncon, 4);
  const std::vector<double> before = full();
  const int row = first_contact_row(), entries = data_->nJ;
  added(row) = {kAfter, kBefore};
  added(row + 1) = {kAfter, kAfter};
  added(row + 2) = {kBox, -1};  // has it already
  ASSERT_TRUE(add());
  EXPECT_EQ(full(), before);
  EXPECT_EQ(data_->nJ, entries + 3);
  EXPECT_EQ(data_->efc_J_rownnz[row], 8);
  EXPECT_EQ(data_->efc_J_rownnz[row + 1], 7);
  EXPECT_EQ(data_->efc_J_rownnz[row + 2], 6);
  ASSERT_NE(sparse_entry(data_.get(), row, kBefore), nullptr);
  EXPECT_EQ(sparse_entry(data_.get(), row, kAfter + 1), nullptr);
  *sparse_entry(data_.get(), row, kAfter) = 2.5;
  EXPECT_EQ(full()[static_cast<std::size_t>(row * model_->nv + kAfter)], 2.5);
}

TEST_F(SparseColumns, StaySortedAndLeaveBlocksOfOnePatternOnly) {
  start("1M");
  const int row = first_contact_row();
  for (int r = row; r < row + 5; ++r) added(r) = {-1, kBefore};
  ASSERT_TRUE(add());
  for (int r = 0; r < data_->nefc; ++r) {
    const int* const begin = data_->efc_J_colind + data_->efc_J_rowadr[r];
    EXPECT_TRUE(std::is_sorted(begin, begin + data_->efc_J_rownnz[r])) << r;
    EXPECT_LE(data_->efc_J_rowsuper[r], alike(r)) << r;
  }
  EXPECT_EQ(data_->efc_J_rowsuper[row], 4);
}

TEST_F(SparseColumns, AreRefusedByAFullArena) {
  start("1M");
  const std::vector<double> before = full();
  added(first_contact_row()) = {kAfter, -1};
  const std::size_t used = data_->parena;
  data_->parena = static_cast<std::size_t>(data_->narena) - 64;
  EXPECT_FALSE(add());
  data_->parena = used;
  EXPECT_EQ(full(), before);
}

TEST_F(SparseColumns, ScratchIsGivenBackAndNeverMoreThanThereIs) {
  start("1M");
  mjData* const d = data_.get();
  const std::size_t stack = d->pstack, room = static_cast<std::size_t>(d->narena) - d->parena;
  {
    const ArenaScratch scratch(d, 100);
    ASSERT_NE(scratch.memory(), nullptr);
    EXPECT_EQ(reinterpret_cast<std::size_t>(scratch.memory()) % alignof(double), 0u);
    EXPECT_GE(d->pstack, stack + 100);
    std::fill_n(static_cast<char*>(scratch.memory()), 100, char{1});
  }
  EXPECT_EQ(d->pstack, stack);
  EXPECT_EQ(ArenaScratch(d, room).memory(), nullptr);
  EXPECT_EQ(d->pstack, stack);
}

}  // namespace
