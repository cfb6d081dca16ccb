#include "Stage.h"

#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>

std::string Root;
static int Checks = 0;
static int Failures = 0;

void Expect(bool bIsTrue, const std::string& Problem, const char* File, int Line)
{
	Checks++;
	if (bIsTrue) return;
	Failures++;
	std::printf("%s:%d: %s\n", File, Line, Problem.c_str());
}

void ExpectSame(const std::string& Actual, const std::string& Expected, const char* File, int Line)
{
	Expect(Actual == Expected, "\n  expected: " + Expected + "\n  actual:   " + Actual, File, Line);
}

FString ToFString(const std::string& Utf8)
{
	return FString(StubUtf16(Utf8));
}

TArray<uint8> ReadFixture(const std::string& Name)
{
	std::ifstream File(Root + "/fixtures/banks/v1/" + Name, std::ios::binary);
	const std::vector<char> Bytes((std::istreambuf_iterator<char>(File)), {});
	TArray<uint8> Result;
	Result.Append(reinterpret_cast<const uint8*>(Bytes.data()), static_cast<int32>(Bytes.size()));
	return Result;
}

ULipzBank* OpenFixture(const std::string& Name)
{
	ULipzBank* Bank = NewObject<ULipzBank>();
	FString Error;
	Bank->SetContents(ReadFixture(Name + ".lipzbank"), Error);
	EXPECT_SAME(Error.Utf8(), "");
	return Bank;
}

std::string Words(const FLipzEvent& Event)
{
	static const char* const Verbs[] = {"", "feels", "sees", "stares", "stops staring", "points", "stops pointing", "does",
		"nods", "shakes", "breathes", "blinks", "looks away"};
	if (Event.Verb == ELipzVerb::Other) return Event.Text.Utf8();
	std::string Result = Event.Character.IsEmpty() ? "" : Event.Character.Utf8() + " ";
	Result += Verbs[static_cast<int>(Event.Verb)];
	if (!Event.Object.IsEmpty()) Result += " " + Event.Object.Utf8();
	return Result;
}

FStage::FStage(const std::string& Bank, const std::vector<std::string>& Shapes)
	: Actor(NewObject<AActor>())
	, Player(NewObject<ULipzPlayerComponent>())
	, Audio(NewObject<UAudioComponent>())
	, Mesh(NewObject<USkeletalMeshComponent>())
	, Sound(NewObject<USoundWave>())
{
	Mesh->StubMesh = NewObject<USkeletalMesh>();
	for (const std::string& Name : Shapes)
	{
		const FString Spelled = ToFString(Name);
		Mesh->StubMesh->StubTargets.Add(NewObject<UMorphTarget>(nullptr, UMorphTarget::StaticClass(), FName(*Spelled)));
	}
	Actor->StubAdd(NewObject<USkeletalMeshComponent>()); // a body without morph targets
	Actor->StubAdd(Mesh);
	Actor->StubAdd(Audio);
	Actor->StubAdd(Player);
	Sound->StubDuration = 4.0f;
	Player->Bank = OpenFixture(Bank);
	Player->Rig = FString();
	Player->bHoldConsonants = false;
	Player->SetLocale(TEXT("de-de"));
	Player->OnEvent.AddLambda([this](const FLipzEvent& Event) { Report(Words(Event)); });
	Player->OnSubtitle.AddLambda([this](const FText& Text) { Report('"' + Text.ToString().Utf8() + '"'); });
	Player->OnFinished.AddLambda([this] { Report("finished"); });
}

void FStage::Report(const std::string& Text)
{
	Reported += (Reported.empty() ? "" : "; ") + Text;
}

void FStage::Tick(double Seconds, ELevelTick Type)
{
	FPlatformTime::StubSeconds += Seconds;
	if (Player->bStubTicks) Player->TickComponent(static_cast<float>(Seconds), Type, nullptr);
}

std::string FStage::Take()
{
	return std::exchange(Reported, "");
}

float FStage::Shape(const std::string& Name) const
{
	const FString Spelled = ToFString(Name);
	const float* Found = Mesh->StubWeights.Find(FName(*Spelled));
	return Found == nullptr ? 0.0f : *Found;
}

int main(int Count, char** Arguments)
{
	const bool bIsBench = Count == 3 && std::string(Arguments[2]) == "bench";
	if (Count != 2 && !bIsBench)
	{
		std::fprintf(stderr, "usage: unreal ROOT [bench]\n");
		return 2;
	}
	Root = Arguments[1];
	const std::pair<const char*, void (*)()> Tests[] = {{"banks", TestBanks}, {"damage", TestDamage}, {"cases", TestCases},
		{"players", TestPlayers}, {"audio", TestAudio}, {"handlers", TestHandlers}, {"faces", TestFaces},
		{"imports", TestImports}, {"guide", TestGuide}, {"frames", TestFrames}};
	for (const auto& [Name, Test] : Tests)
	{
		if (bIsBench && Test != TestFrames) continue;
		const int Before = Checks;
		Test();
		std::printf("%s: %d checks\n", Name, Checks - Before);
		StubCollectGarbage();
	}
	std::printf("%d checks, %d failures\n", Checks, Failures);
	return Failures == 0 && Checks > 0 ? 0 : 1;
}
