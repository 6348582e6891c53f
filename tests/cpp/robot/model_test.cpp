// Strategy: every way a model can be missing or broken ends in an Error that names it and keeps
// MuJoCo's words; no way leaves a file behind.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "hurcules/robot/robot.hpp"
#include "support/expect.hpp"
#include "support/tiny_models.hpp"

namespace {

using namespace hurcules;
using namespace hurcules_test;
namespace fs = std::filesystem;

class Model : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("hurcules_" + std::to_string(getpid()) + "_" + std::string(test->name()));
    fs::create_directories(folder_);
    back_ = fs::current_path();
    fs::current_path(folder_);
  }
  void TearDown() override {
    EXPECT_FALSE(fs::exists("MUJOCO_LOG.TXT"));
    fs::current_path(back_);
    fs::remove_all(folder_);
  }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }
  fs::path folder_, back_;
};

TEST_F(Model, ReadsAFile) {
  write("arm.xml", kArm);
  EXPECT_EQ(Robot(load_model("arm.xml")).size(), 7);
}

TEST_F(Model, TextLooksForItsFilesInTheFolder) {
  write("parts/arm.xml", kArm);
  const std::string text = "<mujoco><include file='arm.xml'/></mujoco>";
  EXPECT_EQ(Robot(load_model_text(text, (folder_ / "parts").string())).size(), 7);
  EXPECT_TRUE(contains(error_text([&] { (void)load_model_text(text); }), "arm.xml"));
}

TEST_F(Model, MissingFileIsNamed) {
  EXPECT_EQ(error_text([] { (void)load_model("no/such.xml"); }),
            "model 'no/such.xml' does not exist");
}

TEST_F(Model, BrokenFileKeepsMujocosWords) {
  write("broken.xml", "<mujoco><worldbody><bodi/></worldbody></mujoco>");
  const std::string text = error_text([] { (void)load_model("broken.xml"); });
  EXPECT_TRUE(contains(text, "model 'broken.xml' cannot be loaded")) << text;
  EXPECT_TRUE(contains(text, "bodi")) << text;
}

TEST_F(Model, UrdfWhoseLimitsWouldBeLostSaysWhatConvertsIt) {
  write("arm.urdf", "<robot name='arm'><link name='base'/></robot>");
  const std::string text = error_text([] { (void)load_model("arm.urdf"); });
  EXPECT_TRUE(contains(text, "hurcules.load_urdf")) << text;
  const std::string with_comment =
      "<?xml version='1.0'?>\n<!-- <mujoco> -->\n<robot name='arm'><link name='base'/></robot>";
  const std::string of_text = error_text([&] { (void)load_model_text(with_comment); });
  EXPECT_TRUE(contains(of_text, "hurcules.load_urdf")) << of_text;
}

TEST_F(Model, BrokenTextKeepsMujocosWords) {
  const std::string no_mass = "<mujoco><worldbody><body><freejoint/></body></worldbody></mujoco>";
  const std::string text = error_text([&] { (void)load_model_text(no_mass); });
  EXPECT_TRUE(contains(text, "model text cannot be loaded")) << text;
  EXPECT_TRUE(contains(text, "mass")) << text;
}

TEST_F(Model, BrokenBinaryIsAnErrorToo) {
  write("broken.mjb", "this is not a model");
  EXPECT_TRUE(contains(error_text([] { (void)load_model("broken.mjb"); }), "'broken.mjb'"));
}

TEST_F(Model, NoModelIsAnError) {
  EXPECT_TRUE(contains(error_text([] { (void)borrow_model(nullptr); }), "null"));
  EXPECT_TRUE(contains(error_text([] { Robot robot(nullptr); }), "wants a model"));
}

TEST_F(Model, BorrowedModelStaysTheOwners) {
  const ModelPtr model = load_model_text(kArm);
  {
    const Robot robot(borrow_model(model.get()));
  }
  EXPECT_EQ(Robot(model).size(), 7);
}

TEST_F(Model, VersionOfMujocoIsOurs) {
  EXPECT_NO_THROW(check_mujoco_version());
}

}  // namespace
