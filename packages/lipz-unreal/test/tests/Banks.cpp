// The queries of a bank.

#include "Internationalization/Culture.h"
#include "Internationalization/Internationalization.h"
#include "Stage.h"

static std::string Joined(const TArray<FString>& Items)
{
	std::string Result;
	for (const FString& Item : Items) Result += (Result.empty() ? "" : " ") + Item.Utf8();
	return Result;
}

static std::string Text(const ULipzBank* Bank, const TCHAR* Locale, int32 Segment = 1)
{
	return Bank->GetText(TEXT("act1/mara-good-evening"), Segment, Locale).ToString().Utf8();
}

static void TestTextsOfLanguages()
{
	const ULipzBank* Drama = OpenFixture("drama");
	EXPECT_SAME(Text(Drama, TEXT("de-de")), "Du bist spät dran,");
	EXPECT_SAME(Text(Drama, TEXT("de-DE")), "Du bist spät dran,");
	EXPECT_SAME(Text(Drama, TEXT("de_DE")), "Du bist spät dran,");
	EXPECT_SAME(Text(Drama, TEXT("de")), "Du bist spät dran,");
	EXPECT_SAME(Text(Drama, TEXT("de-CH")), "Du bist spät dran,");
	EXPECT_SAME(Text(Drama, TEXT("xx")), Text(Drama, TEXT("en-us")));
	EXPECT(Text(Drama, TEXT("ja-jp")) != Text(Drama, TEXT("en-us")));
	const auto Language = FInternationalization::Get().GetCurrentLanguage();
	Language->StubName = TEXT("de-AT");
	EXPECT_SAME(Text(Drama, TEXT("")), "Du bist spät dran,");
	Language->StubName = TEXT("en-US");
	EXPECT_SAME(Text(Drama, TEXT("")), Text(Drama, TEXT("en-us")));
	EXPECT_SAME(Text(Drama, TEXT("de-de"), 9), "");
	EXPECT_SAME(Text(Drama, TEXT("de-de"), -1), "");
}

static void TestFilesOnTop()
{
	FString Error;
	ULipzBank* Split = OpenFixture("split");
	EXPECT_SAME(Joined(Split->GetLocales()), "");
	EXPECT(Split->AddFile(ReadFixture("split.de-de.lipztexts"), Error));
	EXPECT(Split->AddFile(ReadFixture("split.en-us.lipztexts"), Error));
	EXPECT_SAME(Split->GetText(TEXT("act1/toonboom"), 1, TEXT("de-de")).ToString().Utf8(), "deutsch");
	EXPECT_SAME(Split->GetText(TEXT("act1/blair"), 1, TEXT("en-us")).ToString().Utf8(), "Mayor.");
	EXPECT(!Split->AddFile(ReadFixture("redub.lipzbank"), Error));
	EXPECT_SAME(Error.Utf8().substr(0, 11), "the patch w");
	EXPECT_SAME(Split->GetText(TEXT("act1/blair"), 1, TEXT("en-us")).ToString().Utf8(), "Mayor.");

	ULipzBank* Drama = OpenFixture("drama");
	EXPECT(!Drama->AddFile(ReadFixture("split.de-de.lipztexts"), Error));
	EXPECT_SAME(Error.Utf8(), "the texts belong to a bank with other clips (file 1, byte 24)");
	ULipzBank* Small = OpenFixture("small");
	EXPECT(!Small->AddFile(ReadFixture("redub.lipzbank"), Error));
	EXPECT(!Small->AddFile({}, Error));
	const int32 Before = Small->GetClipKeys(TEXT("")).Num();
	EXPECT(Small->AddFile(ReadFixture("patch.lipzbank"), Error));
	EXPECT(Small->GetClipKeys(TEXT("")).Num() == Before); // one is added, one is removed
	EXPECT(Small->SetContents(ReadFixture("split.lipzbank"), Error) && Small->GetLocales().Num() == 0);
	EXPECT(Small->AddFile(ReadFixture("split.de-de.lipztexts"), Error) && Small->GetLocales().Num() == 1);
}

void TestBanks()
{
	const ULipzBank* Drama = OpenFixture("drama");
	EXPECT(Drama->GetClipKeys(TEXT("")).Num() == 48);
	EXPECT(Drama->GetClipKeys(TEXT("act1/")).Num() < 48);
	EXPECT_SAME(Joined(Drama->GetClipKeys(TEXT("act1/mara-good"))), "act1/mara-good-evening");
	EXPECT(Drama->HasClip(TEXT("act1/mara-good-evening")) && !Drama->HasClip(TEXT("act1/mara")) && !Drama->HasClip(TEXT("")));
	EXPECT(Drama->GetClipSeconds(TEXT("act1/mara-good-evening")) > 3.7f);
	EXPECT(Drama->GetClipSeconds(TEXT("missing")) == 0.0f);
	EXPECT_SAME(Drama->GetVisemeAt(TEXT("act1/mara-good-evening"), 0.05f).Utf8(), "O");
	EXPECT_SAME(Drama->GetVisemeAt(TEXT("act1/mara-good-evening"), -1.0f).Utf8(), "-");
	EXPECT(Drama->GetLocales().Num() == 12 && Drama->GetVoices().Num() == 0);
	EXPECT_SAME(Drama->GetKeyInVoice(TEXT("act1/mara-good-evening"), TEXT("de-de")).Utf8(), "act1/mara-good-evening");

	const ULipzBank* Dubbed = OpenFixture("dubbed");
	EXPECT_SAME(Joined(Dubbed->GetVoices()), "en-us de-at de-de");
	const FString Line = Dubbed->GetClipKeys(TEXT("de/"))[0].Mid(3);
	EXPECT_SAME(Dubbed->GetKeyInVoice(Line, TEXT("de-de")).Utf8(), "de/" + Line.Utf8());
	EXPECT_SAME(Dubbed->GetKeyInVoice(Line, TEXT("de-DE")).Utf8(), "de/" + Line.Utf8());
	EXPECT_SAME(Dubbed->GetKeyInVoice(Line, TEXT("en-us")).Utf8(), Line.Utf8());
	EXPECT_SAME(Dubbed->GetKeyInVoice(Line, TEXT("xx-xx")).Utf8(), Line.Utf8());

	const ULipzBank* Curves = OpenFixture("curves");
	EXPECT(Curves->GetCurveAt(TEXT("act1/rig"), TEXT("jawOpen"), 0.1f) == 0.824f);
	EXPECT(Curves->GetCurveAt(TEXT("act1/rig"), TEXT("tail"), 0.1f) == 0.0f);
	EXPECT(Curves->GetCurveAt(TEXT("act1/wide"), TEXT("尾"), 0.0f) == 40.0f);
	TestTextsOfLanguages();
	TestFilesOnTop();

	const ULipzBank* Empty = NewObject<ULipzBank>();
	EXPECT(!Empty->HasClip(TEXT("a")) && Empty->GetClipKeys(TEXT("")).Num() == 0 && !Empty->GetDialogue().IsValid());
	EXPECT_SAME(StubLog.back(), "Stub: the file is shorter than the header of a bank (file 0, byte 0). Import the bank again.");
}
