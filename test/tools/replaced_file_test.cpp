#include "replaced_file.h"

#include "tools/program.h"

namespace cloth
{
namespace
{

using Names = std::vector<std::string>;

class ReplacedFileTest : public InAFolder
{
};

TEST_F(ReplacedFileTest, TakesThePlaceOfWhatWasThereWhenItIsCommitted)
{
  const std::string file = write("file", "old and longer than the new");
  ReplacedFile replaced(file);
  replaced.stream() << "new" << std::flush;
  EXPECT_EQ(text_of(file), "old and longer than the new");
  replaced.commit();
  EXPECT_EQ(text_of(file), "new");
  EXPECT_EQ(files(), Names{ "file" });
}

TEST_F(ReplacedFileTest, IsNotThereBeforeItIsCommitted)
{
  ReplacedFile replaced(path("file"));
  replaced.stream() << "new" << std::flush;
  EXPECT_FALSE(std::filesystem::exists(path("file")));
  replaced.commit();
  EXPECT_EQ(text_of(path("file")), "new");
}

TEST_F(ReplacedFileTest, LeavesNothingBehindWhereItIsNotCommitted)
{
  const std::string file = write("file", "old");
  {
    ReplacedFile replaced(file);
    replaced.stream() << "new" << std::flush;
    EXPECT_EQ(files().size(), 2u);
  }
  EXPECT_EQ(text_of(file), "old");
  EXPECT_EQ(files(), Names{ "file" });
}

TEST_F(ReplacedFileTest, RemovesAllUncommittedFilesAtOnceAndNoCommittedOne)
{
  ReplacedFile committed(path("a"));
  committed.commit();
  ReplacedFile one(path("b"));
  ReplacedFile other(path("c"));
  EXPECT_EQ(files().size(), 3u);
  ReplacedFile::remove_uncommitted();
  EXPECT_EQ(files(), Names{ "a" });
}

TEST_F(ReplacedFileTest, FollowsALink)
{
  write("file", "old");
  std::filesystem::create_symlink("file", path("link"));
  ReplacedFile replaced(path("link"));
  replaced.stream() << "new";
  replaced.commit();
  EXPECT_EQ(text_of(path("file")), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
}

TEST_F(ReplacedFileTest, RefusesWhatCannotBeWrittenByName)
{
  for (const std::string& bad : { path("no_folder/file"), path(".") })
  {
    try
    {
      ReplacedFile replaced(bad);
      ADD_FAILURE() << bad;
    }
    catch (const std::runtime_error& error)
    {
      EXPECT_TRUE(has(error.what(), { "cannot be written: " })) << bad;
    }
  }
  EXPECT_TRUE(files().empty());
}

TEST_F(ReplacedFileTest, SaysWhenTheDiskIsFull)
{
  ReplacedFile replaced("/dev/full");
  replaced.stream() << "new";
  try
  {
    replaced.commit();
    ADD_FAILURE();
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_TRUE(has(error.what(), { "/dev/full cannot be written" }));
  }
}

}  // namespace
}  // namespace cloth
