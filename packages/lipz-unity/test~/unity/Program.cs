using System;
using System.IO;
using System.Linq;
using System.Reflection;

namespace Lipz.UnityTests
{
    /// <summary>
    /// Tests the components against stubs of the engine: <c>unity.exe ROOT EXPECTED</c>, with the output of the guide.
    /// </summary>
    internal static class Program
    {
        private static int failures;

        private static int Main(string[] arguments)
        {
            string fixtures = Path.Combine(arguments[0], "fixtures");
            string samples = Path.Combine(arguments[0], "packages/lipz-unity/Samples~");
            string sample = Path.Combine(samples, "Conversation/conversation.lipzbank");
            Test("tests of the package", PackageTests);
            Test("audio of any rate", () => AudioRates.Compare(fixtures));
            Test("rest", () => RestingMouths.Check(fixtures));
            Test("jumps, loops and the end", () => Playback.Check(fixtures));
            Test("importers", () => Importers.Check(fixtures));
            Test("timeline", () => TimelineTracks.Check(fixtures));
            Test("blend shapes and sprites", () => Mouths.Check(fixtures));
            Test("sample", () => SampleScene.Play(sample));
            Test("program of the guide", () => GuideProgram.Run(fixtures, File.ReadAllText(arguments[1])));
            Test("memory of a tick", () => Ticks.Measure(fixtures));
            return failures == 0 ? 0 : 1;
        }

        private static void Test(string name, Func<string> test)
        {
            try
            {
                Console.WriteLine("{0}: {1}", name, test());
            }
            catch (Exception error)
            {
                failures++;
                Console.WriteLine("FAILED {0}: {1}", name, error);
            }
        }

        /// <summary>Runs the tests that are for the Test Runner of Unity.</summary>
        private static string PackageTests()
        {
            int count = 0;
            foreach (Type type in typeof(Lipz.Tests.BankTests).Assembly.GetTypes())
            {
                var tests = type.GetMethods().Where(method => method.GetCustomAttributes(false)
                    .Any(attribute => attribute is NUnit.Framework.TestAttribute));
                foreach (MethodInfo test in tests)
                {
                    ((Action)Delegate.CreateDelegate(typeof(Action), Activator.CreateInstance(type), test))();
                    count++;
                }
            }
            return count + " passed";
        }
    }
}
