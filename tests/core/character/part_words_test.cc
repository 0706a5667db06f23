#include "core/character/part_words.h"

#include <gtest/gtest.h>

namespace capfit::character {
namespace {

struct NamedKind {
  const char* name;
  std::optional<PartKind> kind;
};

class KindFromNameTest : public testing::TestWithParam<NamedKind> {};

TEST_P(KindFromNameTest, TellsTheThingThatTheNameMeans) {
  EXPECT_EQ(KindFromName(GetParam().name), GetParam().kind) << GetParam().name;
}

INSTANTIATE_TEST_SUITE_P(
    Names, KindFromNameTest,
    testing::Values(
        NamedKind{"Wolf_Head", PartKind::kBody}, NamedKind{"Body_01_HANDS", PartKind::kBody},
        NamedKind{"EyeLeft", PartKind::kInner}, NamedKind{"FaceEyelash", PartKind::kInner},
        NamedKind{"teeth_base", PartKind::kInner},
        NamedKind{"Wolf_Outfit_Footwear", PartKind::kShoe},
        NamedKind{"Shoes_01_CLOTH", PartKind::kShoe},
        NamedKind{"male_casualsuit_trousers", PartKind::kClothing},
        NamedKind{"Brown_Shirt", PartKind::kClothing}, NamedKind{"Tops", PartKind::kClothing},
        NamedKind{"HAIR 2", PartKind::kHair}, NamedKind{"brown-hair", PartKind::kHair},
        NamedKind{"SkirtLong", PartKind::kSkirt}, NamedKind{"HandBag", PartKind::kAccessory},
        NamedKind{"handbag", PartKind::kAccessory}, NamedKind{"Hat", PartKind::kAccessory},
        NamedKind{"Hats", PartKind::kAccessory}, NamedKind{"hatch", std::nullopt},
        NamedKind{"capsule", std::nullopt}, NamedKind{"dressed", std::nullopt},
        NamedKind{"Mesh_07", std::nullopt}, NamedKind{"", std::nullopt},
        NamedKind{"\xff\xfe", std::nullopt}));

TEST(PartKindName, IsAWordForEach) {
  EXPECT_EQ(PartKindName(PartKind::kBody), "body");
  EXPECT_EQ(PartKindName(PartKind::kFragment), "fragment");
}

}  // namespace
}  // namespace capfit::character
