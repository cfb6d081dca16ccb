// Handlers that stop the player, start the next clip or replace the bank. All events still happen, once and in order.

#include "Stage.h"

#include <functional>

static const TCHAR* const Evening = TEXT("act1/mara-good-evening");

/** Plays one clip, and calls a function once, at an event, a subtitle or the end. */
static std::string PlayedWith(const std::string& At, const std::function<void(FStage&)>& Call)
{
	FStage Stage("drama");
	bool bWasCalled = false;
	const auto Once = [&](const std::string& Reported) {
		if (bWasCalled || Reported != At) return;
		bWasCalled = true;
		Call(Stage);
	};
	Stage.Player->OnEvent.AddLambda([&](const FLipzEvent& Event) { Once(Words(Event)); });
	Stage.Player->OnSubtitle.AddLambda([&](const FText& Text) { Once(Text.ToString().Utf8()); });
	Stage.Player->OnFinished.AddLambda([&] { Once("finished"); });
	Stage.Player->Play(Evening);
	for (int Frame = 0; Frame < 20; Frame++) Stage.Tick(2.0);
	EXPECT(bWasCalled);
	EXPECT(!Stage.Player->IsPlaying());
	return Stage.Take();
}

/** A handler of an event that Stop makes due, which starts the next clip. */
static void TestNextClipAtStop()
{
	FStage Stage("drama");
	int Starts = 0;
	Stage.Player->OnEvent.AddLambda([&](const FLipzEvent& Event) {
		if (Words(Event) == "sees otto" && Starts++ == 0) EXPECT(Stage.Player->Play(Evening));
	});
	Stage.Player->Play(Evening);
	Stage.Tick(0.1);
	Stage.Player->Stop();
	EXPECT_SAME(Stage.Take(), "feels neutral; \"Guten Abend, Otto.\"; sees otto; points fog; \"\"");
	EXPECT(Stage.Player->IsPlaying());
	Stage.Tick(0.1);
	EXPECT_SAME(Stage.Take(), "feels neutral; \"Guten Abend, Otto.\"");
}

void TestHandlers()
{
	TestNextClipAtStop();
	const std::string Whole = "feels neutral; \"Guten Abend, Otto.\"; sees otto; \"Du bist spät dran,\"; points fog; \"\"; finished";
	const auto Nothing = [](FStage&) {};
	const auto Stop = [](FStage& Stage) { Stage.Player->Stop(); };
	const auto Again = [](FStage& Stage) { EXPECT(Stage.Player->Play(Evening)); };
	EXPECT_SAME(PlayedWith("sees otto", Nothing), Whole);
	EXPECT_SAME(PlayedWith("feels neutral", Stop), "feels neutral; sees otto; points fog");
	EXPECT_SAME(PlayedWith("sees otto", Stop), "feels neutral; \"Guten Abend, Otto.\"; sees otto; points fog; \"\"");
	EXPECT_SAME(PlayedWith("points fog", Stop), "feels neutral; \"Guten Abend, Otto.\"; sees otto; \"Du bist spät dran,\"; points fog; \"\"");
	EXPECT_SAME(PlayedWith("Du bist spät dran,", Stop), "feels neutral; \"Guten Abend, Otto.\"; sees otto; \"Du bist spät dran,\"; points fog; \"\"");
	EXPECT_SAME(PlayedWith("sees otto", Again), "feels neutral; \"Guten Abend, Otto.\"; sees otto; points fog; \"\"; " + Whole);
	EXPECT_SAME(PlayedWith("", Again), Whole.substr(0, Whole.size() - 10) + "; " + Whole);
	EXPECT_SAME(PlayedWith("finished", Again), Whole + "; " + Whole);

	// A new version of the bank, in which the clip continues.
	const auto Replace = [](FStage& Stage) {
		FString Error;
		EXPECT(Stage.Player->Bank->SetContents(ReadFixture("drama.lipzbank"), Error));
	};
	for (const char* const At : {"feels neutral", "Guten Abend, Otto.", "points fog"}) EXPECT_SAME(PlayedWith(At, Replace), Whole);
	// A bank without the clip: the player does not crash.
	const auto Remove = [](FStage& Stage) {
		FString Error;
		EXPECT(Stage.Player->Bank->SetContents(ReadFixture("small.lipzbank"), Error));
		Stage.Tick(1.0);
		Stage.Player->Stop();
	};
	EXPECT_SAME(PlayedWith("sees otto", Remove).substr(0, 45), "feels neutral; \"Guten Abend, Otto.\"; sees ott");
}
