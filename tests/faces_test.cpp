// The parts that the bindings of Python and JavaScript share.
#include <gtest/gtest.h>

#include <any>
#include <limits>
#include <map>

#include "faces/axes.h"
#include "support/generate.h"

namespace medial {
namespace {

/// Options by name, as a binding passes them on.
struct Named {
  std::map<std::string, std::any> given;

  template <class T>
  Named& take(const char* name, T& to) {
    if (given.contains(name)) to = std::any_cast<T>(given[name]);
    given.erase(name);
    return *this;
  }
};

Status take(const char* method_name, std::map<std::string, std::any> given, Method& method) {
  method = *method_from(method_name);
  Named named{std::move(given)};
  Status taken = faces::take_own(named, method);
  EXPECT_TRUE(named.given.empty());
  return taken;
}

TEST(Faces, ChoicesOfMethodsAreTakenByName) {
  Method method;
  ASSERT_TRUE(take("ridge",
                   {{"search", std::string("sorted-list")},
                    {"rule", std::string("difference")},
                    {"pixels", std::uint32_t{64}}},
                   method));
  const auto& ridge = std::get<method::Ridge>(method);
  EXPECT_TRUE(ridge.sorted_list);
  EXPECT_EQ(ridge.rule, RidgeRule::difference);
  EXPECT_EQ(ridge.grid.pixels, 64U);
  ASSERT_TRUE(take("brushfire", {{"family", std::string("marking")}}, method));
  EXPECT_EQ(std::get<method::Brushfire>(method).family, Brushfire::marking);
  ASSERT_TRUE(take("potential",
                   {{"order", 2.0}, {"start", std::optional<std::array<double, 2>>({3, 4})}},
                   method));
  const auto& potential = std::get<method::Potential>(method);
  EXPECT_EQ(potential.order, 2);
  EXPECT_EQ(potential.from, (Vec2{3, 4}));
}

TEST(Faces, ChoicesThatDoNotExistAreErrors) {
  const auto refused = [](const char* name, const char* option) {
    Method method;
    const Status taken = take(name, {{option, std::string("lists")}}, method);
    return !taken && taken.error().code == ErrorCode::invalid_option &&
           taken.error().text.starts_with(std::string(option) + " is one of ") &&
           taken.error().text.ends_with("not 'lists'");
  };
  EXPECT_TRUE(refused("ridge", "search"));
  EXPECT_TRUE(refused("ridge", "rule"));
  EXPECT_TRUE(refused("brushfire", "family"));
}

TEST(Faces, StoredAxesHaveToFitTogether) {
  const auto axis = compute(*build_shape(test::rectangle(3, 1)));
  ASSERT_TRUE(axis.ok());
  EXPECT_TRUE(faces::sound(*axis).ok());
  const auto refused = [&](const auto& damage) {
    MedialAxis damaged = *axis;
    damage(damaged);
    const auto result = faces::sound(std::move(damaged));
    return !result.ok() && result.error().code == ErrorCode::malformed;
  };
  EXPECT_TRUE(refused([](MedialAxis& a) { a.edges[0].node[1] = 1000; }));
  EXPECT_TRUE(refused([](MedialAxis& a) { a.edges[0].site[0] = 1000; }));
  EXPECT_TRUE(refused([](MedialAxis& a) { a.edges[0].weight = 0; }));
  EXPECT_TRUE(refused([](MedialAxis& a) { a.nodes[0].disk.radius = -1; }));
  EXPECT_TRUE(refused(
      [](MedialAxis& a) { a.nodes[0].disk.center.x = std::numeric_limits<double>::infinity(); }));
}

TEST(Faces, LinesFollowBranches) {
  const auto axis = compute(*build_shape(test::rectangle(3, 1)));
  std::vector<Disk> disks;
  std::vector<double> begin{0};
  faces::add_lines(*axis, 0.01, 0, disks, begin);
  EXPECT_EQ(begin.size(), branches(*axis).size() + 1);
  EXPECT_EQ(begin.back(), static_cast<double>(disks.size()));
  const std::size_t chords = disks.size();
  faces::add_lines(*axis, 0.01, 0.1, disks, begin);
  EXPECT_GT(disks.size(), 2 * chords);  // a step of 0.1 samples straight edges, too
}

}  // namespace
}  // namespace medial
