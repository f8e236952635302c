#include "core/io/model_table.h"

#include <string>

#include <gtest/gtest.h>

#include "core/io/files.h"
#include "core/io/osim_reader.h"

namespace gaitmill {
namespace {

ModelSpec readShipped() {
  const std::string path = "models/rajagopal2016/rajagopal2016.osim";
  return readOsim(readFile(path), path);
}

bool holds(const std::string& text, const std::string& line) {
  return text.find("\n" + line + "\n") != std::string::npos;
}

TEST(ModelTable, MusclesAreLaidOutAsInThePaper) {
  const std::string text = formatModelTable(readShipped());
  EXPECT_TRUE(holds(text, "Muscle            F0M [N]  l0M [cm]  lsT [cm]  alpha0 [deg]"));
  EXPECT_TRUE(holds(text, "soleus               6195       4.4      27.7          21.9")) << text;
  EXPECT_TRUE(holds(text, "addbrev               626      10.3       3.5*          6.6"));
  EXPECT_TRUE(holds(text, "80 muscles (34 with rigid tendon), 40 wrap cylinders"));
  EXPECT_TRUE(holds(text, "22 joints, 39 coordinates (2 coupled, 8 locked)"));
}

TEST(ModelTable, SidesShareARowOnlyWhereTheyAreEqual) {
  ModelSpec spec = readShipped();
  EXPECT_EQ(formatModelTable(spec).find("soleus_"), std::string::npos);
  spec.muscles[static_cast<std::size_t>(spec.findMuscle("soleus_l"))].optimal_fiber_length *= 1.001;
  const std::string text = formatModelTable(spec);
  EXPECT_NE(text.find("\nsoleus_r "), std::string::npos);
  EXPECT_NE(text.find("\nsoleus_l "), std::string::npos);
}

TEST(ModelTable, EmptyModelHasATableToo) {
  EXPECT_NE(formatModelTable({}).find("0 bodies, 0.0000 kg"), std::string::npos);
}

}  // namespace
}  // namespace gaitmill
