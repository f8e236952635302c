#include "core/analysis/emg_channels.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/io/files.h"
#include "core/io/osim_reader.h"

namespace gaitmill {
namespace {

using Names = std::vector<std::string>;

EmgChannel mapOne(const std::string& label, const EmgChannelOptions& options = {}) {
  const EmgChannels mapped = mapEmgChannels({label}, {}, options);
  EXPECT_EQ(mapped.channels.size(), 1U) << label;
  return mapped.channels.empty() ? EmgChannel{} : mapped.channels.front();
}

struct Spelling {
  const char* label;
  Names muscles;
};

TEST(EmgChannels, OfThePublishedTrials) {
  const Spelling cases[] = {{"SOL", {"soleus_r"}},
                            {"GASLAT", {"gaslat_r"}},
                            {"GASMED", {"gasmed_r"}},
                            {"TA", {"tibant_r"}},
                            {"MH", {"semimem_r", "semiten_r"}},
                            {"SM", {"semimem_r"}},
                            {"BF", {"bflh_r"}},
                            {"BFLH", {"bflh_r"}},
                            {"VL", {"vaslat_r"}},
                            {"VM", {"vasmed_r"}},
                            {"RF", {"recfem_r"}},
                            {"GMAX", {"glmax1_r", "glmax2_r", "glmax3_r"}},
                            {"GMED", {"glmed1_r", "glmed2_r", "glmed3_r"}},
                            {"gastrocnemius", {"gasmed_r", "gaslat_r"}},
                            {"tibialis_anterior", {"tibant_r"}},
                            {"medial_hamstrings", {"semimem_r", "semiten_r"}},
                            {"biceps_femoris", {"bflh_r"}},
                            {"gluteus_medius", {"glmed1_r", "glmed2_r", "glmed3_r"}},
                            {"glmax1r", {"glmax1_r"}},
                            {"semitenr", {"semiten_r"}},
                            {"vasmedr", {"vasmed_r"}}};
  for (const Spelling& spelling : cases) {
    const EmgChannel channel = mapOne(spelling.label);
    Names expected = spelling.muscles;
    Names found = channel.muscles;
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected) << spelling.label;
    EXPECT_EQ(channel.side, BodySide::kRight) << spelling.label;
  }
}

TEST(EmgChannels, AsMeasuringSystemsSpellThem) {
  const Spelling cases[] = {{"R TIBIALIS ANTERIOR: EMG 1", {"tibant_r"}},
                            {"L RECTUS FEMORIS: EMG 12 [V]", {"recfem_l"}},
                            {"LT TIB.ANT.,uV", {"tibant_l"}},
                            {"RT VASTUS LAT.", {"vaslat_r"}},
                            {"Voltage.RTA", {"tibant_r"}},
                            {"EMG.L_GASTROC_MED", {"gasmed_l"}},
                            {"LSOL", {"soleus_l"}},
                            {"SOLL", {"soleus_l"}},
                            {"LRF", {"recfem_l"}},
                            {"soleus_l", {"soleus_l"}},
                            {"soleusl", {"soleus_l"}},
                            {"RightSoleus", {"soleus_r"}},
                            {"left gluteus maximus", {"glmax1_l", "glmax2_l", "glmax3_l"}},
                            {"Gastrocnemius lateralis", {"gaslat_r"}},
                            {"Lateral gastrocnemius (left)", {"gaslat_l"}},
                            {"LG", {"gaslat_r"}},
                            {"MG_L", {"gasmed_l"}},
                            {"3: L.Semitendinosus", {"semiten_l"}},
                            {"TensorFasciaeLatae_R", {"tfl_r"}},
                            {"IM EMG7", {}},
                            {"Sync", {}},
                            {"ACC.X", {}}};
  for (const Spelling& spelling : cases) {
    EXPECT_EQ(mapOne(spelling.label).muscles, spelling.muscles) << spelling.label;
  }
}

TEST(EmgChannels, WithoutSideBelongToTheSideOfTheSettings) {
  EmgChannelOptions options;
  options.side = BodySide::kLeft;
  EXPECT_EQ(mapOne("SOL", options).muscles, Names{"soleus_l"});
  EXPECT_EQ(mapOne("R_SOL", options).muscles, Names{"soleus_r"});
}

TEST(EmgChannels, TheSettingsHaveTheLastWord) {
  EmgChannelOptions options;
  options.channels = {{"GAS", {"gaslat"}},
                      {"L_GAS", {"gaslat", "gasmed_l"}},
                      {"EMG 4", {"soleus_l"}},
                      {"SYNC", {}},
                      {"VL", {"vaslatt"}},
                      {"absent", {"soleus_r"}}};
  const EmgChannels mapped =
      mapEmgChannels({"GAS", "L_GAS", "EMG 4", "SYNC", "VL", "TA"}, {}, options);
  ASSERT_EQ(mapped.channels.size(), 5U);
  EXPECT_EQ(mapped.channels[0].muscles, Names{"gaslat_r"});
  EXPECT_EQ(mapped.channels[1].muscles, (Names{"gaslat_l", "gasmed_l"}));
  EXPECT_EQ(mapped.channels[1].side, BodySide::kLeft);
  EXPECT_EQ(mapped.channels[2].muscles, Names{"soleus_l"});
  EXPECT_EQ(mapped.channels[2].side, BodySide::kLeft);
  EXPECT_EQ(mapped.channels[3].channel, "VL");
  EXPECT_EQ(mapped.channels[3].column, 4);
  EXPECT_TRUE(mapped.channels[3].muscles.empty());
  EXPECT_EQ(mapped.channels[4].muscles, Names{"tibant_r"});
  ASSERT_EQ(mapped.warnings.size(), 2U);
  EXPECT_NE(mapped.warnings[0].find("'vaslatt'"), std::string::npos);
  EXPECT_NE(mapped.warnings[1].find("'absent'"), std::string::npos);
}

TEST(EmgChannels, UnknownNamesAreToldWithTheWayOut) {
  const EmgChannels mapped = mapEmgChannels({"EMG 4", ""}, {}, {});
  ASSERT_EQ(mapped.warnings.size(), 2U);
  EXPECT_NE(mapped.warnings[0].find("emg.channels"), std::string::npos);
}

// The names of gait2392 and the models that grew out of it.
TEST(EmgChannels, ModelsOfOthersHaveTheirOwnNames) {
  Names muscles;
  for (const char* name : {"glut_med1",
                           "glut_max1",
                           "glut_max2",
                           "glut_max3",
                           "semimem",
                           "semiten",
                           "bifemlh",
                           "bifemsh",
                           "rect_fem",
                           "vas_med",
                           "vas_int",
                           "vas_lat",
                           "med_gas",
                           "lat_gas",
                           "soleus",
                           "tib_ant"}) {
    muscles.push_back(std::string(name) + "_r");
    muscles.push_back(std::string(name) + "_l");
  }
  const EmgChannels mapped =
      mapEmgChannels({"L_TA", "GAS", "GMAX", "BF", "VL", "RF", "SOL", "MH"}, muscles, {});
  const Names expected[] = {{"tib_ant_l"},
                            {"med_gas_r", "lat_gas_r"},
                            {"glut_max1_r", "glut_max2_r", "glut_max3_r"},
                            {"bifemlh_r"},
                            {"vas_lat_r"},
                            {"rect_fem_r"},
                            {"soleus_r"},
                            {"semimem_r", "semiten_r"}};
  ASSERT_EQ(mapped.channels.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(mapped.channels[i].muscles, expected[i]) << mapped.channels[i].channel;
  }
}

TEST(EmgChannels, EveryMuscleOfTheOwnModelIsKnownByItsName) {
  Names muscles;
  const std::string path = "models/rajagopal2016/rajagopal2016.osim";
  for (const MuscleSpec& muscle : readOsim(readFile(path), path).muscles) {
    muscles.push_back(muscle.name);
  }
  const EmgChannels mapped = mapEmgChannels(muscles, muscles, {});
  EXPECT_TRUE(mapped.warnings.empty());
  for (const EmgChannel& channel : mapped.channels) {
    EXPECT_EQ(channel.muscles, Names{channel.channel});
  }
}

}  // namespace
}  // namespace gaitmill
