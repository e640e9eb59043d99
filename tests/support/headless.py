"""Headless Chromium for tests of pages (packages chromium chromium-driver python3-selenium). A test that cannot have one ends with
code 77, which ctest reports as skipped, and says why."""
import shutil
import sys


def skip(page, why):
    """Ends the test. page: what was not tested, "the report"."""
    print("=" * 78)
    print(f"SKIPPED: {page} was NOT tested in a browser:", why)
    print("Install chromium, chromium-driver and python3-selenium (scripts/test does, where it can).")
    print("=" * 78)
    sys.exit(77)


def open_browser(page, arguments, downloads=None):
    """A browser that logs what reaches its console. downloads: the folder for files that are saved."""
    try:
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service
    except ImportError as error:
        skip(page, error)
    browser, driver = shutil.which("chromium"), shutil.which("chromedriver")
    if not browser or not driver:
        skip(page, "no " + ("chromium" if not browser else "chromedriver"))
    options = webdriver.ChromeOptions()
    options.binary_location = browser
    for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--window-size=1280,900",
                     "--force-device-scale-factor=1", *arguments):
        options.add_argument(argument)
    if downloads:
        options.add_experimental_option("prefs", {"download.default_directory": str(downloads)})
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(driver), options=options)
