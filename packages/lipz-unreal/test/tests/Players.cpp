// Clips that a player plays with its own clock, or with that of the program.

#include "Internationalization/StringTable.h"
#include "Internationalization/StringTableCore.h"
#include "LipzDialogue.h"
#include "LipzStrings.h"
#include "Stage.h"

static const TCHAR* const Evening = TEXT("act1/mara-good-evening");
static const std::string EveningInGerman = "mara feels neutral; \"Guten Abend, Otto.\"; mara sees otto; \"Du bist spät dran,\"; "
	"mara points fog; \"und der Nebel ist zu früh.\"; \"\"; finished";

/** Plays a clip to its end. */
static std::string Played(FStage& Stage, const FString& Key, double FrameSeconds)
{
	if (!Stage.Player->Play(Key)) return "not played";
	for (int Frame = 0; Frame < 100000 && Stage.Player->IsPlaying(); Frame++) Stage.Tick(FrameSeconds);
	Stage.Tick(FrameSeconds);
	return Stage.Take();
}

/** The events of a clip in its order, read with the C library alone. */
static std::string EventsInBank(const ULipzBank* Bank, const FString& Key)
{
	const lipz_dialogue* Dialogue = Bank->GetDialogue()->Get();
	lipz_clip Clip;
	lipz_segment Segment;
	lipz_event Event;
	std::string Result;
	Bank->GetDialogue()->FindClip(Key, Clip);
	for (uint32 Part = 0; lipz_clip_segment(Dialogue, &Clip, Part, &Segment) == LIPZ_OK; Part++)
	{
		for (uint32 Index = 0; lipz_segment_event(Dialogue, &Segment, Index, &Event) == LIPZ_OK; Index++)
		{
			FLipzEvent Same;
			Same.Character = LipzStrings::ToFString(Event.character.name);
			Same.Verb = static_cast<ELipzVerb>(Event.verb);
			Same.Object = LipzStrings::ToFString(Event.object.name);
			Result += Words(Same) + "\n";
		}
		lipz_string Text;
		if (lipz_segment_event(Dialogue, &Segment, 0, &Event) != LIPZ_OK &&
			lipz_segment_event_string(Dialogue, &Segment, &Text) == LIPZ_OK && Text.length_bytes > 0)
		{
			Result += LipzStrings::ToFString(Text).Utf8() + "\n";
		}
	}
	return Result + "finished\n";
}

static void TestEachEventOnce()
{
	for (const char* const Name : {"drama", "small", "faces", "dubbed"})
	{
		FStage Stage(Name);
		std::string Events;
		Stage.Player->OnEvent.AddLambda([&](const FLipzEvent& Event) { Events += Words(Event) + "\n"; });
		Stage.Player->OnFinished.AddLambda([&] { Events += "finished\n"; });
		for (const FString& Key : Stage.Player->Bank->GetClipKeys(TEXT("")))
		{
			if (Stage.Player->Bank->GetClipSeconds(Key) == 0.0f) continue;
			const std::string Expected = EventsInBank(Stage.Player->Bank, Key);
			for (const double Frame : {1.0 / 240, 1.0 / 60, 1.0 / 24, 0.3, 100.0})
			{
				Events.clear();
				Played(Stage, Key, Frame);
				EXPECT_SAME(Events, Expected);
			}
		}
	}
}

static void TestSubtitles()
{
	FStage Stage("drama");
	Stage.Player->Speaker = TEXT("mara");
	EXPECT_SAME(Played(Stage, Evening, 1.0 / 60), EveningInGerman);
	EXPECT_SAME(Played(Stage, Evening, 60.0),
		"mara feels neutral; \"Guten Abend, Otto.\"; mara sees otto; mara points fog; \"\"; finished");
	Stage.Player->SetLocale(TEXT("en-us"));
	EXPECT_SAME(Played(Stage, Evening, 1.0 / 60), "mara feels neutral; \"Good evening, Otto.\"; mara sees otto; "
		"\"You are late,\"; mara points fog; \"and the fog is early.\"; \"\"; finished");

	// While a clip plays.
	Stage.Player->Play(Evening);
	Stage.Tick(0.1);
	EXPECT_SAME(Stage.Take(), "mara feels neutral; \"Good evening, Otto.\"");
	Stage.Player->SetLocale(TEXT("de-de"));
	EXPECT_SAME(Stage.Take(), "\"Guten Abend, Otto.\"");
	EXPECT_SAME(Stage.Player->GetSubtitle().ToString().Utf8(), "Guten Abend, Otto.");
	Stage.Player->Stop();
	EXPECT_SAME(Stage.Take(), "mara sees otto; mara points fog; \"\"");
	EXPECT(Stage.Player->GetSubtitle().IsEmpty());
}

static void TestStringTables()
{
	FStage Stage("drama");
	Stage.Player->Speaker = TEXT("mara");
	UStringTable* Table = NewObject<UStringTable>();
	Table->GetStringTable()->StubTexts["act1/mara-good-evening|1"] = TEXT("Bonsoir.");
	Table->GetStringTable()->StubTexts["act1/mara-good-evening"] = TEXT("All of it.");
	Table->GetStringTable()->StubTexts["act1/mara-good-evening|3"] = TEXT("Le brouillard.");
	Stage.Player->SubtitleTable = Table;
	Stage.Player->Play(Evening);
	for (int Frame = 0; Frame < 300; Frame++) Stage.Tick(1.0 / 60);
	EXPECT_SAME(Stage.Take(), "mara feels neutral; \"Bonsoir.\"; mara sees otto; \"Du bist spät dran,\"; mara points fog; "
		"\"Le brouillard.\"; \"\"; finished");
}

static void TestYourClock()
{
	FStage Stage("drama");
	Stage.Player->Speaker = TEXT("mara");
	EXPECT(Stage.Player->Begin(Evening));
	Stage.Tick(100.0);
	EXPECT_SAME(Stage.Take(), "");
	Stage.Player->AdvanceTo(-1.0f);
	EXPECT_SAME(Stage.Take(), "");
	Stage.Player->AdvanceTo(0.05f);
	EXPECT_SAME(Stage.Take(), "mara feels neutral; \"Guten Abend, Otto.\"");
	EXPECT_SAME(Stage.Player->GetViseme().Utf8(), "O");
	Stage.Player->AdvanceTo(1.6f);
	Stage.Player->AdvanceTo(1.4f); // jitter
	Stage.Player->AdvanceTo(1.6f);
	EXPECT_SAME(Stage.Take(), "mara sees otto; \"Du bist spät dran,\"; \"Guten Abend, Otto.\"; \"Du bist spät dran,\"");
	Stage.Player->Seek(0.0f);
	Stage.Player->AdvanceTo(0.0f);
	EXPECT_SAME(Stage.Take(), "mara feels neutral; \"Guten Abend, Otto.\"");
	Stage.Player->Seek(3.0f);
	Stage.Player->AdvanceTo(3.0f);
	EXPECT_SAME(Stage.Take(), "\"und der Nebel ist zu früh.\"");
	Stage.Player->AdvanceTo(99.0f);
	EXPECT_SAME(Stage.Take(), "\"\"; finished");
	EXPECT_SAME(Stage.Player->GetViseme().Utf8(), "-");
	Stage.Player->AdvanceTo(99.0f);
	EXPECT_SAME(Stage.Take(), "");
}

static void TestPauses()
{
	FStage Stage("drama", {"A", "O", "S", "rest"});
	Stage.Player->Play(Evening);
	for (int Frame = 0; Frame < 4; Frame++) Stage.Tick(0.02);
	EXPECT(Stage.Shape("O") == 1.0f && Stage.Shape("S") == 0.0f);
	Stage.Player->SetPaused(true);
	EXPECT(Stage.Shape("O") == 0.0f);
	Stage.Tick(50.0);
	EXPECT(Stage.Player->IsPlaying());
	Stage.Player->SetPaused(false);
	Stage.Tick(0.0);
	EXPECT(Stage.Shape("O") == 1.0f);
	Stage.Tick(50.0, LEVELTICK_PauseTick);
	EXPECT(Stage.Shape("O") == 0.0f && Stage.Player->IsPlaying());
	Stage.Tick(0.0);
	EXPECT(Stage.Shape("O") == 1.0f);
	Stage.Player->Stop();
	EXPECT(Stage.Shape("O") == 0.0f && !Stage.Player->IsPlaying() && !Stage.Player->bStubTicks);
}

void TestPlayers()
{
	TestEachEventOnce();
	TestSubtitles();
	TestStringTables();
	TestYourClock();
	TestPauses();
	FStage Stage("small");
	EXPECT(!Stage.Player->Play(TEXT("act2/unspecified")));
	EXPECT_SAME(StubLog.back(), "Stub: the clip \"act2/unspecified\" has no frame rate");
	EXPECT(!Stage.Player->Play(TEXT("missing")));
	EXPECT_SAME(StubLog.back(), "Stub: the bank has no clip \"missing\"");
}
