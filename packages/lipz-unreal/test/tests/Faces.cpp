// The weights of faces, compared with those that the C library computes.

#include "LipzDialogue.h"
#include "LipzStrings.h"
#include "Stage.h"

#include <cmath>

/** The weights of a rig at a time, computed with the C library alone. */
static std::vector<float> WeightsInBank(const ULipzBank* Bank, const FString& Key, const FString& Rig, float Seconds, const char* Speaker)
{
	const lipz_dialogue* Dialogue = Bank->GetDialogue()->Get();
	lipz_clip Clip;
	lipz_rig Found;
	lipz_articulation Articulation;
	lipz_emotions Emotions;
	lipz_face Face;
	const lipz_time Time = lipz_time_seconds(static_cast<double>(Seconds));
	const lipz_who Who = {{Speaker, std::char_traits<char>::length(Speaker)}, 1};
	EXPECT(Bank->GetDialogue()->FindClip(Key, Clip) && Bank->GetDialogue()->FindRig(Rig, Found));
	lipz_clip_articulation_at(Dialogue, &Clip, Time, nullptr, &Articulation);
	lipz_clip_emotions_at(Dialogue, &Clip, Time, &Who, &Emotions);
	lipz_clip_face_at(Dialogue, &Clip, Time, &Who, nullptr, nullptr, &Face);
	std::vector<int32> Thousandths(Found.weight_count);
	lipz_rig_weights(Dialogue, &Found, &Articulation, &Emotions, &Face, Thousandths.data(), Thousandths.size());
	std::vector<float> Weights;
	for (const int32 Value : Thousandths) Weights.push_back(static_cast<float>(Value) / 1000.0f);
	return Weights;
}

static std::vector<std::string> RigNames(const ULipzBank* Bank, const FString& Rig)
{
	std::vector<std::string> Names;
	lipz_rig Found;
	lipz_string Name;
	EXPECT(Bank->GetDialogue()->FindRig(Rig, Found));
	for (uint32 Index = 0; lipz_rig_weight_name(Bank->GetDialogue()->Get(), &Found, Index, &Name) == LIPZ_OK; Index++)
	{
		Names.push_back(LipzStrings::ToFString(Name).Utf8());
	}
	return Names;
}

/** How a model may spell a name. */
static std::string Spelled(std::string Name, int Way)
{
	const auto IsSide = [&](const std::string& Side) { return Name.size() > Side.size() && Name.ends_with(Side); };
	if (Way == 1) return Name[0] = static_cast<char>(std::toupper(Name[0])), Name;
	if (Way == 2) return "blendShape1." + Name;
	if (Way == 3 && IsSide("Left")) return Name.substr(0, Name.size() - 4) + "_L";
	if (Way == 3 && IsSide("Right")) return Name.substr(0, Name.size() - 5) + "_R";
	if (Way == 4 && IsSide("Left")) return "head." + Name.substr(0, Name.size() - 3);
	return Name;
}

static void TestRig(const char* BankName, const FString& Rig, const std::vector<FString>& Keys, int Way)
{
	FStage Stage(BankName);
	const std::vector<std::string> Names = RigNames(Stage.Player->Bank, Rig);
	std::vector<std::string> Shapes = {"Body_Breath"};
	for (const std::string& Name : Names) Shapes.push_back(Spelled(Name, Way));
	FStage Shaped(BankName, Shapes);
	Shaped.Player->Rig = Rig;
	Shaped.Player->Speaker = TEXT("mara");
	int Moved = 0;
	for (const FString& Key : Keys)
	{
		EXPECT(Shaped.Player->Begin(Key));
		for (int Step = 0; Step < 200; Step++)
		{
			const float Seconds = static_cast<float>(Step) * 0.0713f;
			if (Seconds >= Shaped.Player->Bank->GetClipSeconds(Key)) break;
			Shaped.Player->AdvanceTo(Seconds);
			const std::vector<float> Expected = WeightsInBank(Shaped.Player->Bank, Key, Rig, Seconds, "mara");
			bool bIsSame = true;
			for (size_t I = 0; I < Names.size(); I++)
			{
				const FString Name = ToFString(Names[I]);
				bIsSame = bIsSame && Shaped.Shape(Spelled(Names[I], Way)) == Expected[I] && Shaped.Player->GetWeight(FName(*Name)) == Expected[I];
				Moved += Expected[I] != 0.0f ? 1 : 0;
			}
			EXPECT(bIsSame);
		}
		Shaped.Player->Stop();
		for (const std::string& Shape : Shapes) EXPECT(Shaped.Shape(Shape) == 0.0f);
	}
	EXPECT(Moved > 100);
	EXPECT(Shaped.Mesh->StubPrerequisite == Shaped.Player);
	EXPECT(Shaped.Mesh->StubWeights.Find(FName(TEXT("Body_Breath"))) == nullptr);
}

static void TestVisemes()
{
	FStage Stage("drama", {"A", "Mouth_O", "viseme_S", "Fist"});
	Stage.Player->MorphTargets.Add(TEXT("E"), TEXT("fist"));
	Stage.Player->Begin(TEXT("act1/mara-good-evening"));
	Stage.Player->AdvanceTo(0.0f);
	EXPECT(Stage.Shape("viseme_S") == 1.0f && Stage.Shape("Mouth_O") == 0.0f && Stage.Player->GetWeight(TEXT("S")) == 1.0f);
	Stage.Player->AdvanceTo(0.05f);
	EXPECT(Stage.Shape("viseme_S") == 0.0f && Stage.Shape("Mouth_O") == 1.0f);
	Stage.Player->AdvanceTo(0.25f);
	EXPECT_SAME(Stage.Player->GetViseme().Utf8(), "E");
	EXPECT(Stage.Shape("Fist") == 1.0f);

	// Consonants that are held, and a lead.
	FStage Held("small", {"M", "O"});
	Held.Player->bHoldConsonants = true;
	Held.Player->Begin(TEXT("act1/blair"));
	Held.Player->AdvanceTo(2.0f / 24.0f + 0.001f);
	EXPECT_SAME(Held.Player->GetViseme().Utf8(), "M");
	Held.Player->LeadFrames = 1;
	Held.Player->Begin(TEXT("act1/blair"));
	Held.Player->AdvanceTo(0.001f);
	EXPECT_SAME(Held.Player->GetViseme().Utf8(), "M");
}

static void TestCurves()
{
	FStage Stage("curves", {"jawOpen", "BrowInnerUp", "tail"});
	Stage.Player->Begin(TEXT("act1/rig"));
	Stage.Player->AdvanceTo(0.1f);
	EXPECT(Stage.Shape("jawOpen") == 0.824f && Stage.Shape("BrowInnerUp") == -0.25f && Stage.Shape("tail") == 0.0f);
	EXPECT(Stage.Player->GetWeight(TEXT("anger")) == Stage.Player->Bank->GetCurveAt(TEXT("act1/rig"), TEXT("anger"), 0.1f));
	EXPECT(Stage.Player->GetWeight(TEXT("missing")) == 0.0f);
	EXPECT(Stage.Player->GetWeights().Num() > 3);
	Stage.Player->Rig = TEXT("arkit");
	Stage.Player->Begin(TEXT("act1/rig"));
	bool bIsLogged = false;
	for (const std::string& Line : StubLog)
	{
		bIsLogged = bIsLogged || Line == "Stub: the bank has no rig \"arkit\": add arkit = true to [rig] in lipz.toml, and pack again";
	}
	EXPECT(bIsLogged);

	// A face that was chosen by the program.
	USkeletalMeshComponent* Mesh = NewObject<USkeletalMeshComponent>();
	Stage.Player->Face = Mesh;
	Stage.Player->Begin(TEXT("act1/rig"));
	Stage.Player->AdvanceTo(0.1f);
	EXPECT(Mesh->StubWeights.Num() == 0 && Stage.Shape("jawOpen") == 0.0f);
}

void TestFaces()
{
	const ULipzBank* Bank = OpenFixture("phones");
	std::vector<FString> Keys;
	for (const FString& Key : Bank->GetClipKeys(TEXT("")))
	{
		if (Bank->GetClipSeconds(Key) > 0.0f) Keys.push_back(Key);
	}
	for (int Way = 0; Way < 5; Way++) TestRig("rigs", TEXT("arkit"), {TEXT("english")}, Way);
	for (const TCHAR* const Rig : {TEXT("ovr"), TEXT("vrm"), TEXT("mmd"), TEXT("live2d"), TEXT("azure"), TEXT("facefx"), TEXT("vrchat")})
	{
		TestRig("rigs", Rig, {TEXT("english")}, 0);
	}
	TestRig("phones", TEXT("arkit"), Keys, 0);
	TestVisemes();
	TestCurves();
}
