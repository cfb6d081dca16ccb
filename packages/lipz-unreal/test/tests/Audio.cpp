// Clips that a player plays along with an audio component.

#include "Stage.h"

static const TCHAR* const Evening = TEXT("act1/mara-good-evening");

/** Reports the position of the recording, and ticks. */
static void Hear(FStage& Stage, float Seconds)
{
	Stage.Audio->StubReport(Stage.Sound, Seconds / Stage.Sound->StubDuration);
	Stage.Tick(0.25);
}

static void Begin(FStage& Stage)
{
	Stage.Player->Speaker = TEXT("mara");
	EXPECT(Stage.Player->PlayWithSound(Evening, Stage.Sound));
	EXPECT(Stage.Audio->IsPlaying() && Stage.Audio->Sound == Stage.Sound);
}

static void TestToTheEnd()
{
	FStage Stage("drama", {"O", "S"});
	Begin(Stage);
	Stage.Tick(0.25);
	EXPECT_SAME(Stage.Take(), ""); // the audio has not begun
	Hear(Stage, 0.05f);
	EXPECT_SAME(Stage.Take(), "mara feels neutral; \"Guten Abend, Otto.\"");
	EXPECT(Stage.Shape("O") == 1.0f);
	Hear(Stage, 0.05f);
	Hear(Stage, 0.04f);
	Hear(Stage, 1.5f);
	Hear(Stage, 1.45f);
	Hear(Stage, 1.5f);
	EXPECT_SAME(Stage.Take(), "mara sees otto; \"Du bist spät dran,\"; \"Guten Abend, Otto.\"; \"Du bist spät dran,\"");
	Hear(Stage, 3.9f); // after the last frame of the clip, before the end of the recording
	EXPECT_SAME(Stage.Take(), "mara points fog; \"\"");
	EXPECT(Stage.Player->IsPlaying() && Stage.Shape("O") == 0.0f);
	Stage.Audio->Stop();
	Stage.Tick(0.25);
	EXPECT_SAME(Stage.Take(), "finished");
	EXPECT(!Stage.Audio->OnAudioPlaybackPercentNative.IsBound());
}

/** A recording that ends before its clip, and a handler of the last subtitle that starts the next clip. */
static void TestShortRecording()
{
	FStage Stage("drama");
	bool bIsNext = false;
	Begin(Stage);
	Hear(Stage, 0.05f);
	Stage.Player->OnSubtitle.AddLambda([&](const FText& Text) {
		if (Text.IsEmpty() && !std::exchange(bIsNext, true)) EXPECT(Stage.Player->Play(Evening));
	});
	Stage.Audio->Stop();
	Stage.Tick(0.25);
	EXPECT_SAME(Stage.Take(), "mara feels neutral; \"Guten Abend, Otto.\"; mara sees otto; mara points fog; \"\"");
	EXPECT(Stage.Player->IsPlaying());
	Stage.Tick(0.25);
	EXPECT_SAME(Stage.Take(), "mara feels neutral; \"Guten Abend, Otto.\"");
}

static void TestPause()
{
	FStage Stage("drama", {"O", "S"});
	Begin(Stage);
	Hear(Stage, 0.05f);
	for (const bool bIsOwnPause : {true, false})
	{
		bIsOwnPause ? Stage.Player->SetPaused(true) : Stage.Audio->SetPaused(true);
		EXPECT(Stage.Audio->GetPlayState() == EAudioComponentPlayState::Paused);
		Stage.Tick(0.25);
		EXPECT(Stage.Shape("O") == 0.0f && Stage.Player->IsPlaying());
		bIsOwnPause ? Stage.Player->SetPaused(false) : Stage.Audio->SetPaused(false);
		Stage.Tick(0.25);
		EXPECT(Stage.Shape("O") == 1.0f);
	}
	Stage.Tick(0.25, LEVELTICK_PauseTick);
	EXPECT(Stage.Shape("O") == 0.0f);
	Stage.Audio->bIsUISound = 1;
	Stage.Tick(0.25, LEVELTICK_PauseTick);
	EXPECT(Stage.Shape("O") == 1.0f);
}

static void TestLoops()
{
	// Percentages that go on beyond 1, and percentages that start again.
	for (const bool bGoesOn : {true, false})
	{
		FStage Stage("drama");
		Stage.Sound->bStubLoops = true;
		Begin(Stage);
		Hear(Stage, 0.1f);
		Hear(Stage, 1.5f);
		EXPECT_SAME(Stage.Take(), "mara feels neutral; \"Guten Abend, Otto.\"; mara sees otto; \"Du bist spät dran,\"");
		Hear(Stage, 3.9f);
		Hear(Stage, bGoesOn ? 4.1f : 0.1f);
		EXPECT_SAME(Stage.Take(), "mara points fog; \"\"; mara feels neutral; \"Guten Abend, Otto.\"");
		Hear(Stage, bGoesOn ? 8.1f : 0.08f);
		EXPECT_SAME(Stage.Take(), bGoesOn ? "mara sees otto; mara points fog; mara feels neutral" : "");
		Hear(Stage, bGoesOn ? 9.5f : 1.5f);
		EXPECT_SAME(Stage.Take(), "mara sees otto; \"Du bist spät dran,\"");
		Stage.Player->Stop();
		EXPECT_SAME(Stage.Take(), "mara points fog; \"\"");
		EXPECT(!Stage.Audio->IsPlaying());
	}
}

static void TestOtherAudio()
{
	FStage Stage("drama", {"O"});
	USoundWave* Other = NewObject<USoundWave>();
	Other->StubDuration = 9.0f;
	Begin(Stage);
	Hear(Stage, 0.05f);
	Stage.Audio->StubReport(Other, 0.9f); // of the previous sound
	Stage.Tick(0.25);
	EXPECT_SAME(Stage.Take(), "mara feels neutral; \"Guten Abend, Otto.\"");
	Stage.Audio->SetSound(Other);
	Stage.Audio->Play();
	Stage.Tick(0.25);
	EXPECT_SAME(Stage.Take(), "mara sees otto; mara points fog; \"\""); // cut off, not finished
	EXPECT(Stage.Audio->IsPlaying() && Stage.Shape("O") == 0.0f);

	// The same sound again: a late report of the end arrives after the start.
	Begin(Stage);
	Stage.Audio->StubReport(Stage.Sound, 0.99f);
	Stage.Tick(0.02);
	EXPECT_SAME(Stage.Take(), "");
	Hear(Stage, 0.1f);
	EXPECT_SAME(Stage.Take(), "mara feels neutral; \"Guten Abend, Otto.\"");
	for (const float Invalid : {-1.0f, NAN, INFINITY}) Stage.Audio->StubReport(Stage.Sound, Invalid);
	Stage.Audio->StubReport(nullptr, 0.5f);
	Stage.Tick(0.25);
	EXPECT_SAME(Stage.Take(), "");
	Stage.Player->Seek(3.0f);
	EXPECT(Stage.Audio->StubStart == 3.0f);
	Hear(Stage, 3.05f);
	EXPECT_SAME(Stage.Take(), "\"und der Nebel ist zu früh.\"");
}

static void TestWithoutAudio()
{
	FStage Server("drama");
	Server.Audio->StubState = EAudioComponentPlayState::Stopped;
	Server.Audio->bStubHasDevice = false;
	Server.Player->Speaker = TEXT("mara");
	EXPECT(Server.Player->PlayWithSound(Evening, Server.Sound));
	Server.Tick(0.1);
	EXPECT_SAME(Server.Take(), "mara feels neutral; \"Guten Abend, Otto.\"");
	for (int Frame = 0; Frame < 50; Frame++) Server.Tick(0.1);
	EXPECT_SAME(Server.Take(), "mara sees otto; \"Du bist spät dran,\"; mara points fog; \"und der Nebel ist zu früh.\"; \"\"; finished");

	FStage Silent("drama");
	Silent.Actor->StubComponents.Reset();
	EXPECT(Silent.Player->PlayWithSound(Evening, Silent.Sound));
	EXPECT_SAME(StubLog.back(), "Stub: the actor has no audio component, so no recording plays");
	Silent.Tick(0.1);
	EXPECT_SAME(Silent.Take(), "feels neutral; \"Guten Abend, Otto.\"");

	FStage Left("drama", {"O"});
	Begin(Left);
	Hear(Left, 0.05f);
	Left.Take();
	Left.Player->EndPlay(EEndPlayReason::LevelTransition);
	EXPECT_SAME(Left.Take(), "");
	EXPECT(!Left.Audio->IsPlaying() && Left.Shape("O") == 0.0f);
}

void TestAudio()
{
	TestToTheEnd();
	TestShortRecording();
	TestPause();
	TestLoops();
	TestOtherAudio();
	TestWithoutAudio();
}
